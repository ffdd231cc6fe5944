// The edge points of a model that a camera sees from a given pose: the paper's raster template
// (Sec. 3.1, Fig. 1e).
#pragma once

#include <span>
#include <vector>

#include "host/core/camera.h"
#include "host/model/edge_model.h"
#include "kernels/backend.h"

namespace edgescout {

// Hidden points are removed against a z-buffer of the whole mesh from the same place (kernel
// depth_raster), `depth_map_size_px` square, framed on the object. A point is visible unless every
// one of the 3 x 3 pixels around it lies nearer by more than the tolerance: points on the contour
// border the background and are never lost, at the price of hidden edges showing within one map
// pixel of a contour.
struct VisibilityOptions {
  int depth_map_size_px = 200;
  double tolerance = 0.01;  // of the object's diameter
  void validate() const;    // InputError naming the field and the violated bound
};

// Raster points in the object frame, one list a pose; each pose must have the object in front of
// the camera (points of one that has not: none).
std::vector<std::vector<ModelPoint>> visible_edges(const EdgeModel& model,
                                                   std::span<const Se3> camera_from_object,
                                                   Backend& backend,
                                                   const VisibilityOptions& options = {});

// The kernels' transform and camera.
Pose to_pose(const Se3& b_from_a);
Intrinsics intrinsics_of(const Camera& camera);

}  // namespace edgescout
