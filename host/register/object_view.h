// One calibrated image: pixels, camera, edges, their DCD tensors and the occluders.
//
// pipeline.h makes it in two steps: prepare_view undistorts the image and finds the edges,
// add_tensors builds the tensors (paper, Sec. 3.3). Copies share all data.
//
// Public header.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/edge/edge_index.h"
#include "kernels/backend.h"

namespace edgescout {

struct Occluders;  // occluders.h

struct ObjectView {
  Camera camera;                           // ideal: without distortion
  Se3 camera_from_world;                   // identity where the world is the camera frame
  std::shared_ptr<const Image> image;      // undistorted; null: no shading
  std::shared_ptr<const EdgeIndex> edges;  // null: no edge ICP, no edge claims
  ViewHandle tensor;                       // of all edges, full resolution
  ViewHandle coarse;                       // of all edges, reduced: a wider basin for the search
  ViewHandle salient;    // of the salient edges (edge/salient_edges.h), reduced: for the scan
  Camera coarse_camera;  // of `coarse` and `salient`
  double reduction = 1;  // image px per px of the coarse tensors
  std::shared_ptr<const Occluders> occluders;  // null: no known objects here
};

// The same views with the coarse tensor in the place of the full one; a view without a coarse
// tensor stays as it is.
std::vector<ObjectView> on_coarse_tensors(std::span<const ObjectView> views);

}  // namespace edgescout
