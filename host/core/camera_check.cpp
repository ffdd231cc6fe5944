#include "host/core/camera_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "host/core/lens.h"

namespace edgescout {

namespace {

constexpr double degrees_per_rad = 180 / std::numbers::pi;

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

double view_rad(double size_px, double center_px, double focal_px) {
  return std::atan((center_px + 0.5) / focal_px) +
         std::atan((size_px - 0.5 - center_px) / focal_px);
}

void check_matrix(const Camera& camera, std::vector<std::string>& warnings) {
  const double ratio = camera.fx / camera.fy;
  if (ratio < 0.8 || ratio > 1.25)
    warnings.push_back("fx, fy: found " + short_number(camera.fx) + " and " +
                       short_number(camera.fy) + " px, expected nearly equal values");
  if (std::abs(camera.skew) > 0.01 * camera.fx)
    warnings.push_back("skew: found " + short_number(camera.skew) +
                       " px, expected less than 1 % of the focal length");
  if (camera.width == 0) return;
  constexpr double far_from_middle = 0.2;
  for (const auto& [name, value, size] :
       {std::tuple{"cx", camera.cx, camera.width}, {"cy", camera.cy, camera.height}})
    if (std::abs((value + 0.5) / size - 0.5) > far_from_middle)
      warnings.push_back(std::string(name) + ": found " + short_number(value) + " px in " +
                         std::to_string(size) + " px, expected a principal point near the middle" +
                         " (an image that was cut, or a calibration of another size?)");
  const double view = view_rad(camera.width, camera.cx, camera.fx) * degrees_per_rad;
  if (camera.lens == LensModel::BrownConrady && (view > 140 || view < 2))
    warnings.push_back("fx: found " + short_number(camera.fx) + " px, a view of " +
                       short_number(view) + " degrees, expected 2 to 140 (is it in px?)");
}

// The longest way that the lens moves a point on the image's border, px.
double largest_shift_px(const Camera& camera) {
  double largest = 0;
  for (const double x : {-0.5, 0.5 * (camera.width - 1), camera.width - 0.5})
    for (const double y : {-0.5, 0.5 * (camera.height - 1), camera.height - 0.5}) {
      Camera pinhole = camera;
      pinhole.field_of_view_rad = 0;
      const Eigen::Vector3d ray = ray_through(undistorted(pinhole), {x, y});
      const double shift = (pixel_seeing(camera, ray.head<2>()) - Eigen::Vector2d(x, y)).norm();
      largest = std::max(largest, shift);
    }
  return largest;
}

void check_lens(const Camera& camera, std::vector<std::string>& warnings) {
  constexpr double large_tangential = 0.05;
  if (camera.lens == LensModel::BrownConrady || camera.lens == LensModel::ModifiedBrownConrady)
    for (const auto& [name, p] :
         {std::pair{"p1", camera.distortion[2]}, {"p2", camera.distortion[3]}})
      if (std::abs(p) > large_tangential)
        warnings.push_back(
            std::string(name) + ": found " + short_number(p) +
            ", expected less than 0.05: the order is k1 k2 p1 p2 k3 (or a fisheye?)");
  if (camera.width == 0) return;
  if (const std::optional<double> fold = folds_at_px(camera))
    warnings.push_back("distortion: found coefficients that fold the image " + short_number(*fold) +
                       " px from the principal point, expected none that do within the image");
  const double size = std::max(camera.width, camera.height), shift = largest_shift_px(camera);
  if (camera.lens != LensModel::Fisheye && !(shift < size))
    warnings.push_back("distortion: found coefficients that move the image by " +
                       short_number(shift) + " px, expected less than its size");
}

}  // namespace

std::vector<std::string> implausible_in(const Camera& camera) {
  std::vector<std::string> warnings;
  check_matrix(camera, warnings);
  if (camera.has_distortion()) check_lens(camera, warnings);
  return warnings;
}

double horizontal_view_rad(const Camera& camera) {
  return view_rad(camera.width, camera.cx, camera.fx);
}

double vertical_view_rad(const Camera& camera) {
  return view_rad(camera.height, camera.cy, camera.fy);
}

}  // namespace edgescout
