// Errors of a pose against the true one: those of BOP and of the paper.
//
// Public header.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// The criteria of a correct pose: angle and distance are below the paper's bounds; or, if the true
// pose is only known in the image, all vertices are less than this from their places.
inline constexpr double CORRECT_ANGLE_RAD = 0.1;
inline constexpr double CORRECT_DISTANCE_M = 0.005;
inline constexpr double CORRECT_MSPD_PX = 10;

// Returns the maximum symmetry-aware surface distance, m: min over symmetries S of the max over
// vertices x of |P x - T S x|.
double mssd_m(const Se3& estimate, const Se3& truth, const Object& object);
// Returns the same in the image, px (both poses camera_from_object).
double mspd_px(const Se3& estimate, const Se3& truth, const Object& object, const Camera& camera);
// Rotation and translation error at the symmetry for which the pair passes the bounds most easily:
// with the smallest max of angle and distance, each divided by its bound. Of equal ones, the
// symmetry with the smallest angle.
struct PoseError {
  double angle_rad = 0;
  double distance_m = 0;
  bool passes(double max_angle_rad = CORRECT_ANGLE_RAD,
              double max_distance_m = CORRECT_DISTANCE_M) const {
    return angle_rad < max_angle_rad && distance_m < max_distance_m;
  }
  // Returns the larger of both errors, each divided by its bound: below 1 if the pose is correct.
  double of_bounds(double max_angle_rad = CORRECT_ANGLE_RAD,
                   double max_distance_m = CORRECT_DISTANCE_M) const {
    return std::max(angle_rad / max_angle_rad, distance_m / max_distance_m);
  }
};
PoseError pose_error(const Se3& estimate, const Se3& truth, const Symmetries& symmetries,
                     double max_angle_rad = CORRECT_ANGLE_RAD,
                     double max_distance_m = CORRECT_DISTANCE_M);

}  // namespace edgescout
