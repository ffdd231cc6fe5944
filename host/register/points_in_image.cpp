#include "host/register/points_in_image.h"

#include <cmath>

namespace edgescout {

namespace {

bool lies_in(const BackendView& image, const Eigen::Vector3d& in_camera, double margin_px) {
  const Intrinsics& k = image.intrinsics;
  const double u = k.fx * in_camera.x() / in_camera.z() + k.cx,
               v = k.fy * in_camera.y() / in_camera.z() + k.cy;
  return in_camera.z() > 0 && u >= margin_px && v >= margin_px &&
         u <= image.shape.width - 1 - margin_px && v <= image.shape.height - 1 - margin_px;
}

}  // namespace

bool is_wholly_in(const BackendView& image, const EdgeModel& model, const Se3& camera_from_object) {
  const Eigen::Vector3d center = camera_from_object * model.center_m;
  const double nearest_m = center.z() - model.radius_m;
  if (nearest_m <= 0) return false;
  // The sphere's image is longest away from the principal point.
  const double stretched = 1 + center.head<2>().norm() / center.z();
  const double focal_px = std::max(image.intrinsics.fx, image.intrinsics.fy);
  return lies_in(image, center, stretched * focal_px * model.radius_m / nearest_m);
}

void remove_outside(std::vector<ModelPoint>& points, const BackendView& image,
                    const Se3& camera_from_object) {
  std::erase_if(points, [&](const ModelPoint& point) {
    return !lies_in(image, camera_from_object * Eigen::Vector3d(point.x_m, point.y_m, point.z_m),
                    0);
  });
}

}  // namespace edgescout
