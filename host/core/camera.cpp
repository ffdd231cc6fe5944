#include "host/core/camera.h"

#include <cmath>

#include "kernels/error.h"

namespace edgescout {

bool Camera::has_distortion() const {
  for (double k : distortion)
    if (k != 0) return true;
  return false;
}

bool same_intrinsics(const Camera& a, const Camera& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy &&
         a.distortion == b.distortion;
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
  Camera ideal = camera;
  ideal.distortion.fill(0);
  return ideal;
}

Camera scaled(const Camera& camera, double factor) {
  Camera out = camera;
  out.width = static_cast<int>(std::lround(camera.width * factor));
  out.height = static_cast<int>(std::lround(camera.height * factor));
  out.fx *= factor;
  out.fy *= factor;
  out.cx = factor * (camera.cx + 0.5) - 0.5;
  out.cy = factor * (camera.cy + 0.5) - 0.5;
  return out;
}

}  // namespace edgescout
