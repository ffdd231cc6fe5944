#include "host/detect/pose_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edgescout {

namespace {

// Under the identity symmetry. Infinite, without looking further, where it exceeds `limit`.
double corner_distance_m(const Se3& a, const Se3& b, const std::array<Eigen::Vector3d, 8>& corners,
                         double limit) {
  const Eigen::Matrix3d turn = a.rotation.toRotationMatrix() - b.rotation.toRotationMatrix();
  const Eigen::Vector3d shift = a.translation_m - b.translation_m;
  double worst2 = 0;
  for (const Eigen::Vector3d& corner : corners) {
    worst2 = std::max(worst2, (turn * corner + shift).squaredNorm());
    if (worst2 >= limit * limit) return std::numeric_limits<double>::infinity();
  }
  return std::sqrt(worst2);
}

}  // namespace

std::array<Eigen::Vector3d, 8> box_corners(const Mesh& mesh) {
  std::array<Eigen::Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis)
      corners[i][axis] = (i >> axis & 1) ? mesh.box_max_m[axis] : mesh.box_min_m[axis];
  return corners;
}

double pose_distance_m(const Se3& a, const Se3& b, const Mesh& mesh, const Symmetries& symmetries) {
  const std::array<Eigen::Vector3d, 8> corners = box_corners(mesh);
  double best = std::numeric_limits<double>::infinity();
  for (const Se3& symmetry : symmetries.discrete)
    best = std::min(best, corner_distance_m(a, b * symmetry, corners, best));
  return best;
}

KnownPoses::KnownPoses(std::span<const Se3> poses, const Mesh& mesh, const Symmetries& symmetries)
    : symmetries_(symmetries.discrete),
      corners_(box_corners(mesh)),
      center_m_(0.5 * (mesh.box_min_m + mesh.box_max_m)) {
  for (const Se3& symmetry : symmetries_)
    center_motion_m_ = std::max(center_motion_m_, (symmetry * center_m_ - center_m_).norm());
  for (const Se3& pose : poses) add(pose);
}

void KnownPoses::add(const Se3& pose) {
  poses_.push_back(pose);
  centers_m_.push_back(pose * center_m_);
}

bool KnownPoses::any_within(double radius_m, const Se3& pose) const {
  const Eigen::Vector3d here = pose * center_m_;
  // Some corner moves at least as far as the centre.
  const double reach_m = radius_m + center_motion_m_;
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    if ((centers_m_[k] - here).squaredNorm() > reach_m * reach_m) continue;
    for (const Se3& symmetry : symmetries_)
      if (corner_distance_m(pose, poses_[k] * symmetry, corners_, radius_m) < radius_m) return true;
  }
  return false;
}

}  // namespace edgescout
