#include "host/render/optics.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace edgescout {
namespace {

double corner_distance_px(const cv::Size& size, double cx, double cy) {
  return std::hypot(std::max(cx, size.width - 1 - cx), std::max(cy, size.height - 1 - cy));
}

// The radius that the distortion r -> r (1 + k r^2) moves to `distorted`.
double undistorted_radius(double distorted, double k) {
  double radius = distorted;
  for (int i = 0; i < 10; ++i) radius = distorted / (1 + k * radius * radius);
  return radius;
}

// Adds a point's weight to the four pixels around it.
void splat(cv::Mat& kernel, double x, double y, float weight) {
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  kernel.at<float>(y0, x0) += weight * (1 - fx) * (1 - fy);
  kernel.at<float>(y0, x0 + 1) += weight * fx * (1 - fy);
  kernel.at<float>(y0 + 1, x0) += weight * (1 - fx) * fy;
  kernel.at<float>(y0 + 1, x0 + 1) += weight * fx * fy;
}

void convolve(cv::Mat& light, const cv::Mat& kernel) {
  cv::filter2D(light, light, CV_32F, kernel / cv::sum(kernel)[0], {-1, -1}, 0,
               cv::BORDER_REPLICATE);
}

}  // namespace

RadialDistortion::RadialDistortion(const Camera& camera, double corner_px)
    : cx_(camera.cx), cy_(camera.cy) {
  const double corner = corner_distance_px({camera.width, camera.height}, cx_, cy_);
  k_ = corner_px / (corner * corner * corner);
}

Eigen::Vector2d RadialDistortion::before(double x, double y) const {
  const double dx = x - cx_, dy = y - cy_, r = std::hypot(dx, dy);
  const double back = r > 0 ? undistorted_radius(r, k_) / r : 1;
  return {cx_ + back * dx, cy_ + back * dy};
}

void distort_radially(cv::Mat& light, const Camera& camera, double corner_px) {
  if (corner_px == 0) return;
  const RadialDistortion distortion(camera, corner_px);
  cv::Mat map(light.size(), CV_32FC2);
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x) {
      const Eigen::Vector2f from = distortion.before(x, y).cast<float>();
      map.at<cv::Vec2f>(y, x) = {from.x(), from.y()};
    }
  cv::Mat moved;
  cv::remap(light, moved, map, {}, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  light = cv::max(moved, 0);
}

void defocus(cv::Mat& light, double radius_px) {
  if (radius_px <= 0.5) return;
  const int reach = static_cast<int>(std::ceil(radius_px));
  cv::Mat disc(2 * reach + 1, 2 * reach + 1, CV_32F);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)  // the border covers a pixel partly
      disc.at<float>(y + reach, x + reach) =
          static_cast<float>(std::clamp(radius_px + 0.5 - std::hypot(x, y), 0.0, 1.0));
  convolve(light, disc);
}

void blur_by_motion(cv::Mat& light, double length_px, double direction_rad) {
  if (length_px <= 0) return;
  constexpr int SAMPLES_PER_PX = 8;
  const int reach = static_cast<int>(std::ceil(0.5 * length_px)) + 1;
  const int samples = std::max(2, static_cast<int>(std::ceil(SAMPLES_PER_PX * length_px)));
  cv::Mat line = cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_32F);
  for (int i = 0; i < samples; ++i) {
    const double along = length_px * ((i + 0.5) / samples - 0.5);
    splat(line, reach + along * std::cos(direction_rad), reach + along * std::sin(direction_rad),
          1);
  }
  convolve(light, line);
}

void vignette(cv::Mat& light, double corner_loss) {
  if (corner_loss <= 0) return;
  const double cx = 0.5 * (light.cols - 1), cy = 0.5 * (light.rows - 1);
  const double corner2 = cx * cx + cy * cy;
  // cos^4 = 1 / (1 + tan^2)^2, with tan proportional to the distance.
  const double corner_tan2 = 1 / std::sqrt(1 - corner_loss) - 1;
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x) {
      const double tan2 = corner_tan2 * ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / corner2;
      light.at<float>(y, x) /= static_cast<float>((1 + tan2) * (1 + tan2));
    }
}

void scale_contrast(cv::Mat& light, double factor) {
  if (factor == 1) return;
  const double mean = cv::mean(light)[0];
  light = cv::max((light - mean) * factor + mean, 0);
}

}  // namespace edgescout
