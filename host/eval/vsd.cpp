#include "host/eval/vsd.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/kernel_types.h"
#include "kernels/depth_raster.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

double length_of_ray(const Camera& camera, int x, int y) {
  return ray_through(camera, Eigen::Vector2d(x, y)).norm();
}

// The pixels that can show the points: all, if one lies beside or behind the camera.
DistanceWindow window_of(const std::vector<Eigen::Vector3d>& points_m, const Camera& camera,
                         const Se3& camera_from_object) {
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity()),
                 high = -low;
  for (const Eigen::Vector3d& point_m : points_m) {
    const Eigen::Vector3d x = camera_from_object * point_m;
    if (x.z() < DEPTH_NEAR_M) return {0, 0, camera.width, camera.height, {}};
    const Eigen::Array2d pixel = project(camera, x);
    low = low.min(pixel);
    high = high.max(pixel);
  }
  low = low.floor().max(0);
  high = high.ceil().min(Eigen::Array2d(camera.width - 1, camera.height - 1));
  if (!(low <= high).all()) return {};
  const Eigen::Array2i from = low.cast<int>(), to = high.cast<int>();
  return {from.x(), from.y(), to.x() - from.x() + 1, to.y() - from.y() + 1, {}};
}

// Both windows.
DistanceWindow around(const DistanceWindow& a, const DistanceWindow& b) {
  const int left = std::min(a.left, b.left), top = std::min(a.top, b.top);
  return {left,
          top,
          std::max(a.left + a.width, b.left + b.width) - left,
          std::max(a.top + a.height, b.top + b.height) - top,
          {}};
}

bool overlap(const DistanceWindow& a, const DistanceWindow& b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
         b.top < a.top + a.height;
}

bool is_visible(float model_m, float measured_m, double delta_m) {
  return std::isfinite(model_m) && (measured_m == DEPTH_MISSING || model_m - measured_m <= delta_m);
}

}  // namespace

float DistanceWindow::at(int x, int y) const {
  x -= left;
  y -= top;
  if (x < 0 || y < 0 || x >= width || y >= height) return DEPTH_EMPTY;
  return distances_m[static_cast<std::size_t>(y) * width + x];
}

VsdObject::VsdObject(const Object& object)
    : vertices_m_(object.mesh.vertices_m), diameter_m_(object.mesh.diameter_m) {
  for (const Eigen::Vector3d& vertex : vertices_m_)
    for (int axis = 0; axis < 3; ++axis) coordinates_m_.push_back(static_cast<float>(vertex[axis]));
  for (const auto& corners : object.mesh.triangles)
    for (const int corner : corners) triangles_.push_back(static_cast<std::uint32_t>(corner));
}

DistanceWindow VsdObject::seen_by(const Camera& camera, const Se3& camera_from_object) const {
  DistanceWindow window = window_of(vertices_m_, camera, camera_from_object);
  if (window.width == 0) return window;
  window.distances_m.resize(static_cast<std::size_t>(window.width) * window.height);
  Camera shown = camera;
  shown.cx -= window.left;
  shown.cy -= window.top;
  const DepthJob job{to_pose(camera_from_object), intrinsics_of(shown)};
  ThreadPool alone(1);
  depth_raster_fast({coordinates_m_, triangles_}, {&job, 1}, window.width, window.height,
                    window.distances_m, alone);
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      window.distances_m[static_cast<std::size_t>(y) * window.width + x] *=
          static_cast<float>(length_of_ray(camera, window.left + x, window.top + y));
  return window;
}

DepthImage distances_of(const DepthImage& depth, const Camera& camera) {
  check(depth.width == camera.width && depth.height == camera.height,
        "distances_of: depth and camera differ in size");
  DepthImage distances = depth;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x)
      distances.z_m[static_cast<std::size_t>(y) * depth.width + x] *=
          static_cast<float>(length_of_ray(camera, x, y));
  return distances;
}

VsdErrors vsd(const DistanceWindow& estimate, const DistanceWindow& truth,
              const DepthImage& measured_distances, double diameter_m, double delta_m) {
  VsdErrors errors;
  errors.fill(1);
  if (!overlap(estimate, truth)) return errors;
  const DistanceWindow both = around(estimate, truth);
  int visible = 0, in_one = 0;
  std::array<int, VSD_TAUS> apart{};
  for (int y = both.top; y < both.top + both.height; ++y)
    for (int x = both.left; x < both.left + both.width; ++x) {
      const float of_truth = truth.at(x, y), of_estimate = estimate.at(x, y),
                  measured = measured_distances.at(x, y);
      const bool truth_visible = is_visible(of_truth, measured, delta_m);
      const bool estimate_visible = is_visible(of_estimate, measured, delta_m) ||
                                    (truth_visible && std::isfinite(of_estimate));
      visible += truth_visible || estimate_visible;
      in_one += truth_visible != estimate_visible;
      if (!truth_visible || !estimate_visible) continue;
      const double share = std::abs(of_truth - of_estimate) / diameter_m;
      for (int tau = 0; tau < VSD_TAUS; ++tau) apart[tau] += share >= 0.05 * (tau + 1);
    }
  if (visible > 0)
    for (int tau = 0; tau < VSD_TAUS; ++tau)
      errors[tau] = static_cast<double>(apart[tau] + in_one) / visible;
  return errors;
}

}  // namespace edgescout
