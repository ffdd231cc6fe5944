#include "host/detect/suppression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "kernels/error.h"

namespace edgescout {

namespace {

std::array<Eigen::Vector3d, 8> box_corners(const Mesh& mesh) {
  std::array<Eigen::Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis)
      corners[i][axis] = (i >> axis & 1) ? mesh.box_max_m[axis] : mesh.box_min_m[axis];
  return corners;
}

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

double pose_distance_m(const Se3& a, const Se3& b, const Mesh& mesh, const Symmetries& symmetries) {
  const std::array<Eigen::Vector3d, 8> corners = box_corners(mesh);
  double best = std::numeric_limits<double>::infinity();
  for (const Se3& symmetry : symmetries.discrete)
    best = std::min(best, corner_distance_m(a, b * symmetry, corners, best));
  return best;
}

std::vector<std::size_t> suppress_duplicates(std::span<const Se3> poses_best_first,
                                             const Mesh& mesh, const Symmetries& symmetries,
                                             double radius_m, std::size_t most) {
  const std::array<Eigen::Vector3d, 8> corners = box_corners(mesh);
  const Eigen::Vector3d center = 0.5 * (mesh.box_min_m + mesh.box_max_m);
  std::vector<std::size_t> kept;
  std::vector<Eigen::Vector3d> centers;
  for (std::size_t i = 0; i < poses_best_first.size() && kept.size() < most; ++i) {
    const Eigen::Vector3d here = poses_best_first[i] * center;
    bool known = false;
    for (std::size_t k = 0; !known && k < kept.size(); ++k) {
      if ((centers[k] - here).squaredNorm() > radius_m * radius_m &&
          symmetries.discrete.size() == 1)
        continue;
      for (const Se3& symmetry : symmetries.discrete)
        known |= corner_distance_m(poses_best_first[i], poses_best_first[kept[k]] * symmetry,
                                   corners, radius_m) < radius_m;
    }
    if (known) continue;
    kept.push_back(i);
    centers.push_back(here);
  }
  return kept;
}

std::vector<std::size_t> best_distinct(std::span<const Se3> poses, std::span<const double> keys,
                                       const Mesh& mesh, const Symmetries& symmetries,
                                       double radius_m, std::size_t most) {
  check(poses.size() == keys.size(), "best_distinct: one key a pose");
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return keys[i]; });
  std::vector<Se3> ordered;
  for (std::size_t i : order) ordered.push_back(poses[i]);
  std::vector<std::size_t> best;
  for (std::size_t i : suppress_duplicates(ordered, mesh, symmetries, radius_m, most))
    best.push_back(order[i]);
  return best;
}

KnownPoses::KnownPoses(std::span<const Se3> poses, const Mesh& mesh, const Symmetries& symmetries)
    : corners_(box_corners(mesh)), center_m_(0.5 * (mesh.box_min_m + mesh.box_max_m)) {
  for (const Se3& pose : poses)
    for (const Se3& symmetry : symmetries.discrete) poses_.push_back(pose * symmetry);
}

bool KnownPoses::any_within(double radius_m, const Se3& pose) const {
  const Eigen::Vector3d here = pose * center_m_;
  return std::ranges::any_of(poses_, [&](const Se3& known) {
    // Some corner moves at least as far as the centre.
    return (known * center_m_ - here).squaredNorm() < radius_m * radius_m &&
           corner_distance_m(pose, known, corners_, radius_m) < radius_m;
  });
}

}  // namespace edgescout
