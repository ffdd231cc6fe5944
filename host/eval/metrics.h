// Pose-error metrics of BOP and of the paper.
#pragma once

#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// Maximum symmetry-aware surface distance, m: min over symmetries S of max over vertices |P x - T S x|.
double mssd_m(const Se3& estimate, const Se3& truth, const Object& object);
// The same in the image, px (both poses camera_from_object).
double mspd_px(const Se3& estimate, const Se3& truth, const Object& object, const Camera& camera);
// Rotation and translation error, at the symmetry where the pair passes the bounds most easily (smallest max
// of angle and distance, each over its bound; of those alike the one with the smallest angle).
struct PoseError {
  double angle_rad = 0;
  double distance_m = 0;
  bool passes(double max_angle_rad = 0.1, double max_distance_m = 0.005) const {
    return angle_rad < max_angle_rad && distance_m < max_distance_m;
  }
};
PoseError pose_error(const Se3& estimate, const Se3& truth, const Symmetries& symmetries,
                     double max_angle_rad = 0.1, double max_distance_m = 0.005);

}  // namespace edgescout
