// Poses of the caller: 16 numbers each, row by row.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/bindings/c/src/status.h"
#include "host/core/pose_matrix.h"

namespace edgescout::c {

inline Se3 pose_of(const double* rows, const char* name) {
  require(rows, name);
  return pose_of_rows(std::span<const double, 16>(rows, 16), name);
}

inline std::vector<Se3> poses_of(const double* rows, std::size_t count, const char* name) {
  require(rows, name);
  require_count(count, name);
  std::vector<Se3> poses;
  for (std::size_t i = 0; i < count; ++i)
    poses.push_back(pose_of_rows(std::span<const double, 16>(rows + 16 * i, 16),
                                 std::string(name) + "[" + std::to_string(i) + "]"));
  return poses;
}

inline void write_pose(const Se3& pose, double (&to)[16]) { write_rows(pose, to); }

inline void write_covariance(const Matrix6d& covariance, double (&to)[36]) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> rows(to);
  rows = covariance;
}

}  // namespace edgescout::c
