// One calibrated image: pixels, camera, edges, their DCD tensors and the occluders.
//
// A depth image may come with it. pipeline.h makes it in two steps: prepare_view undistorts the
// image and finds the edges, add_tensors builds the tensors (paper, Sec. 3.3). Copies share all
// data.
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

struct Occluders;      // occluders.h
struct MeasuredDepth;  // measured_depth.h

// The tensors of one level of a view's pyramid.
struct ReducedTensors {
  ViewHandle coarse;     // of all edges: a wider basin for the search
  ViewHandle salient;    // of the salient edges (edge/salient_edges.h): for the scan
  Camera camera;         // of both
  double reduction = 1;  // image px per px of both
};

struct ObjectView {
  Camera camera;                               // ideal: without distortion
  Se3 camera_from_world;                       // identity where the world is the camera frame
  std::shared_ptr<const Image> image;          // undistorted; null: no shading
  std::shared_ptr<const MeasuredDepth> depth;  // of the same camera; null: nothing was measured
  std::shared_ptr<const EdgeIndex> edges;      // null: no edge ICP, no edge claims
  DepthHandle depth_values;                    // those of `depth`, set by add_tensors
  ViewHandle tensor;                           // of all edges, full resolution
  std::vector<ReducedTensors> reduced;  // by ascending reduction; views of a scene: equal ones
  std::shared_ptr<const Occluders> occluders;  // null: no known objects here
};

// The size of an object on the reduced tensors, px. Fewer hold too little shape, more cost more.
inline constexpr double REDUCED_SIZE_PX = 48;

// Returns the index of the view's reduction that brings `size_px` nearest to that; 0 where it has
// no reduced tensors.
std::size_t level_for(double size_px, const ObjectView& view);

// Returns the same views with the coarse tensor of a level in the place of the full one; a view
// without reduced tensors stays as it is.
std::vector<ObjectView> on_coarse_tensors(std::span<const ObjectView> views, std::size_t level);

}  // namespace edgescout
