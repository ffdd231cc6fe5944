#include "host/core/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/error.h"

namespace edgescout {

bool Camera::has_distortion() const {
  return lens != LensModel::BrownConrady || skew != 0 || field_of_view_rad != 0 ||
         std::ranges::any_of(distortion, [](double k) { return k != 0; });
}

bool same_intrinsics(const Camera& a, const Camera& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy && a.lens == b.lens &&
         a.distortion == b.distortion && a.skew == b.skew &&
         a.field_of_view_rad == b.field_of_view_rad;
}

bool same_camera(const Camera& a, const Camera& b) {
  return a.width == b.width && a.height == b.height && same_intrinsics(a, b);
}

void validate(const Camera& camera, const std::string& source) {
  const auto number = [](double v) { return std::to_string(v); };
  if (camera.width < 1)
    throw InputError(source, "width", std::to_string(camera.width), "at least 1");
  if (camera.height < 1)
    throw InputError(source, "height", std::to_string(camera.height), "at least 1");
  for (auto [name, value] : {std::pair{"fx", camera.fx}, {"fy", camera.fy}})
    if (!std::isfinite(value) || value <= 0)
      throw InputError(source, name, number(value), "a positive focal length in px");
  for (auto [name, value, size] :
       {std::tuple{"cx", camera.cx, camera.width}, {"cy", camera.cy, camera.height}})
    if (!std::isfinite(value) || value < -size || value > 2.0 * size)
      throw InputError(source, name, number(value), "a principal point in px near the image");
  for (double k : camera.distortion)
    if (!std::isfinite(k)) throw InputError(source, "distortion", number(k), "finite coefficients");
  if (!std::isfinite(camera.skew)) throw InputError(source, "skew", number(camera.skew), "finite");
  const double view = camera.field_of_view_rad;
  if (!(view >= 0 && view < std::numbers::pi))
    throw InputError(source, "field of view", number(view), "0 or more and below pi, rad");
}

Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& x) {
  return {camera.fx * x.x() / x.z() + camera.cx, camera.fy * x.y() / x.z() + camera.cy};
}

Eigen::Vector3d ray_through(const Camera& camera, const Eigen::Vector2d& pixel) {
  return {(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy, 1.0};
}

double size_px(double length_m, double distance_m, const Camera& camera) {
  return 0.5 * (camera.fx + camera.fy) * length_m / distance_m;
}

double distance_at_size_m(double length_m, double size_px, const Camera& camera) {
  return 0.5 * (camera.fx + camera.fy) * length_m / size_px;
}

Camera undistorted(const Camera& camera) {
  Camera ideal{camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy, {}};
  if (camera.field_of_view_rad == 0) return ideal;
  check(camera.width > 0 && camera.height > 0, "undistorted: a field of view without a size");
  ideal.fx = ideal.fy = 0.5 * camera.width / std::tan(0.5 * camera.field_of_view_rad);
  ideal.cx = 0.5 * (camera.width - 1);
  ideal.cy = 0.5 * (camera.height - 1);
  return ideal;
}

Camera scaled(const Camera& camera, double factor) {
  Camera out = camera;
  out.width = static_cast<int>(std::lround(camera.width * factor));
  out.height = static_cast<int>(std::lround(camera.height * factor));
  out.fx *= factor;
  out.fy *= factor;
  out.skew *= factor;
  out.cx = factor * (camera.cx + 0.5) - 0.5;
  out.cy = factor * (camera.cy + 0.5) - 0.5;
  return out;
}

}  // namespace edgescout
