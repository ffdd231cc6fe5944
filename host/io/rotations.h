// Internal to host/io and host/active: reads rotations that were measured or written with few
// digits, as BOP's own files are.
#pragma once

#include <optional>
#include <string>

#include "host/core/se3.h"

namespace edgescout {

// Of one file.
struct ProjectedRotations {
  int count = 0;
  double largest_difference = 0;
};

inline constexpr const char* EXPECTED_ROTATION = "a rotation, to 0.01 in every number";

// Returns the transform with the rotation next to `rotation`. Counts it where the two differ by
// more than rounding. Nothing: a number is not finite, or differs by 0.01 or more.
std::optional<Se3> nearest_rigid(const Eigen::Matrix3d& rotation,
                                 const Eigen::Vector3d& translation_m,
                                 ProjectedRotations& projected);

// Logs, if there were any, one warning for the file.
void warn_of_projected(const ProjectedRotations& projected, const std::string& file);

}  // namespace edgescout
