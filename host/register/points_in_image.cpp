#include "host/register/points_in_image.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace edgescout {

namespace {

bool lies_in(const Camera& camera, const Eigen::Vector3d& in_camera, double margin_px) {
  const Eigen::Vector2d at = project(camera, in_camera);
  return in_camera.z() > 0 && at.x() >= margin_px && at.y() >= margin_px &&
         at.x() <= camera.width - 1 - margin_px && at.y() <= camera.height - 1 - margin_px;
}

bool lies_in(const Camera& camera, const Se3& camera_from_object, const ModelPoint& point) {
  return lies_in(camera, camera_from_object * Eigen::Vector3d(point.x_m, point.y_m, point.z_m), 0);
}

}  // namespace

bool is_wholly_in(const Camera& camera, const EdgeModel& model, const Se3& camera_from_object) {
  const Eigen::Vector3d center = camera_from_object * model.center_m;
  const double nearest_m = center.z() - model.radius_m;
  if (nearest_m <= 0) return false;
  // The sphere's image is longest away from the principal point.
  const double stretched = 1 + center.head<2>().norm() / center.z();
  const double focal_px = std::max(camera.fx, camera.fy);
  return lies_in(camera, center, stretched * focal_px * model.radius_m / nearest_m);
}

std::size_t count_outside(std::span<const ModelPoint> points, const EdgeModel& model,
                          const Camera& camera, const Se3& camera_from_object) {
  if (is_wholly_in(camera, model, camera_from_object)) return 0;
  return std::size_t(std::ranges::count_if(points, [&](const ModelPoint& point) {
    return !lies_in(camera, camera_from_object, point);
  }));
}

void remove_outside(std::vector<ModelPoint>& points, const EdgeModel& model, const Camera& camera,
                    const Se3& camera_from_object) {
  if (is_wholly_in(camera, model, camera_from_object)) return;
  std::vector<ModelPoint> inside;
  std::ranges::copy_if(points, std::back_inserter(inside), [&](const ModelPoint& point) {
    return lies_in(camera, camera_from_object, point);
  });
  if (2 * inside.size() >= points.size()) points = std::move(inside);
}

}  // namespace edgescout
