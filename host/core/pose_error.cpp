#include "host/core/pose_error.h"

#include <algorithm>
#include <limits>

namespace edgescout {
namespace {

// Returns the largest squared error over the vertices. Stops as soon as it reaches `limit`: with
// many symmetries, the first few vertices exclude nearly all of them.
template <typename Squared>
double largest_squared(const Mesh& mesh, double limit, const Squared& squared) {
  double largest = 0;
  for (const Eigen::Vector3d& x : mesh.vertices_m) {
    largest = std::max(largest, squared(x));
    if (largest >= limit) break;
  }
  return largest;
}

}  // namespace

double mssd_m(const Se3& estimate, const Se3& truth, const Object& object) {
  double best = std::numeric_limits<double>::infinity();
  const Eigen::Matrix3d estimate_rotation = estimate.rotation.toRotationMatrix();
  for (const Se3& symmetry : object.symmetries.discrete) {
    const Se3 moved = truth * symmetry;
    const Eigen::Matrix3d rotation = estimate_rotation - moved.rotation.toRotationMatrix();
    const Eigen::Vector3d offset = estimate.translation_m - moved.translation_m;
    best = std::min(best, largest_squared(object.mesh, best, [&](const Eigen::Vector3d& x) {
                      return (rotation * x + offset).squaredNorm();
                    }));
  }
  return std::sqrt(best);
}

double mspd_px(const Se3& estimate, const Se3& truth, const Object& object, const Camera& camera) {
  double best = std::numeric_limits<double>::infinity();
  const Eigen::Matrix3d estimate_rotation = estimate.rotation.toRotationMatrix();
  for (const Se3& symmetry : object.symmetries.discrete) {
    const Se3 moved = truth * symmetry;
    const Eigen::Matrix3d moved_rotation = moved.rotation.toRotationMatrix();
    best = std::min(best, largest_squared(object.mesh, best, [&](const Eigen::Vector3d& x) {
                      const Eigen::Vector3d a = estimate_rotation * x + estimate.translation_m;
                      const Eigen::Vector3d b = moved_rotation * x + moved.translation_m;
                      if (a.z() <= 0 || b.z() <= 0) return std::numeric_limits<double>::infinity();
                      return (project(camera, a) - project(camera, b)).squaredNorm();
                    }));
  }
  return std::sqrt(best);
}

PoseError pose_error(const Se3& estimate, const Se3& truth, const Symmetries& symmetries,
                     double max_angle_rad, double max_distance_m) {
  PoseError best;
  double best_excess = std::numeric_limits<double>::infinity();
  for (const Se3& symmetry : symmetries.discrete) {
    const Se3 moved = truth * symmetry;
    const PoseError error{angle_between_rad(estimate, moved), distance_between_m(estimate, moved)};
    const double excess = error.of_bounds(max_angle_rad, max_distance_m);
    if (excess < best_excess || (excess == best_excess && error.angle_rad < best.angle_rad)) {
      best_excess = excess;
      best = error;
    }
  }
  return best;
}

}  // namespace edgescout
