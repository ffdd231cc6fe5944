#include "host/io/rotations.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cstdio>

#include "host/core/log.h"

namespace edgescout {

namespace {

constexpr double rounding = 5e-4;  // of which nothing is said
constexpr double bound = 0.01;

}  // namespace

std::optional<Se3> nearest_rigid(const Eigen::Matrix3d& rotation,
                                 const Eigen::Vector3d& translation_m,
                                 ProjectedRotations& projected) {
  if (!rotation.allFinite() || !translation_m.allFinite()) return {};
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  const double difference = (rotation - nearest).cwiseAbs().maxCoeff();
  if (nearest.determinant() < 0 || !(difference < bound)) return {};
  if (difference <= rounding) return Se3{Eigen::Quaterniond(rotation).normalized(), translation_m};
  ++projected.count;
  projected.largest_difference = std::max(projected.largest_difference, difference);
  return Se3{Eigen::Quaterniond(nearest).normalized(), translation_m};
}

void warn_of_projected(const ProjectedRotations& projected, const std::string& file) {
  if (projected.count == 0) return;
  char largest[32];
  std::snprintf(largest, sizeof largest, "%.2g", projected.largest_difference);
  log(LogLevel::Warning, file + ": found " + std::to_string(projected.count) +
                             (projected.count == 1 ? " matrix" : " matrices") + " up to " +
                             largest + " off a rotation: the nearest rotation is taken");
}

}  // namespace edgescout
