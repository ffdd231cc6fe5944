// What detection and registration need of one image: its edge points, the DCD tensor at full
// resolution and one reduced.
#pragma once

#include <memory>
#include <vector>

#include "host/core/types.h"
#include "host/edge/edges.h"
#include "host/register/d2co.h"

namespace edgescout {

struct ScanHit;
// Of one object in one image; all who look there share them.
using ScanHits = std::shared_ptr<const std::vector<ScanHit>>;

struct Observation {
  RegisterView view;  // full and coarse tensors, camera, edge index
  ViewHandle
      salient;  // the coarse tensor of the salient edges alone, for the scan (edge/salient_edges.h)
  Camera coarse_camera;
  double reduction = 1;  // image pixels to a coarse pixel
  // What scans of the image found of each object, where they have been made (scan_for,
  // coarse_scan.h).
  std::vector<ScanHits> hits;
};

// Reduction at which something of `size_px` in the image spans about 48 coarse pixels: in [1, 8],
// whole numbers.
double reduction_for(double size_px);

// `image` must be undistorted and `camera` its ideal camera. The coarse tensor's orientation weight
// is lambda / reduction, so that both weigh direction against image distance alike.
Observation observe(const Image& image, const Camera& camera, const Se3& camera_from_world,
                    std::span<const EdgePoint> edges, double reduction, const TensorOptions& tensor,
                    Backend& backend);

std::vector<RegisterView> views_of(std::span<const Observation> observations);

}  // namespace edgescout
