#include "host/render/sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace edgescout {

void add_sensor_noise(cv::Mat& light, double sigma_grey, double gamma, const Random& random) {
  if (sigma_grey <= 0) return;
  const double middle = std::pow(128.0 / 255, gamma);
  const double grey_per_light = 255 / gamma * std::pow(middle, 1 / gamma - 1);
  const double variance = std::pow(sigma_grey / grey_per_light, 2);
  for (int y = 0; y < light.rows; ++y) {
    Random noise = random.split(static_cast<std::uint64_t>(y));
    for (int x = 0; x < light.cols; ++x) {
      float& value = light.at<float>(y, x);
      const double shot = std::max(0.0, value / middle);
      value += static_cast<float>(std::sqrt(0.5 * variance * (1 + shot)) * noise.normal());
    }
  }
}

cv::Mat display_curve(const cv::Mat& light, double gamma) {
  cv::Mat grey(light.size(), CV_64F);
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x)
      grey.at<double>(y, x) =
          255 * std::pow(std::clamp<double>(light.at<float>(y, x), 0.0, 1.0), 1 / gamma);
  return grey;
}

void add_grey_noise(cv::Mat& grey, double sigma_grey, const Random& random) {
  if (sigma_grey <= 0) return;
  for (int y = 0; y < grey.rows; ++y) {
    Random noise = random.split(static_cast<std::uint64_t>(y));
    for (int x = 0; x < grey.cols; ++x) grey.at<double>(y, x) += sigma_grey * noise.normal();
  }
}

void sharpen(cv::Mat& grey, double amount, double radius_px) {
  if (amount <= 0) return;
  cv::Mat blurred;
  cv::GaussianBlur(grey, blurred, {0, 0}, radius_px, radius_px, cv::BORDER_REPLICATE);
  grey += amount * (grey - blurred);
}

Image round_to_image(const cv::Mat& grey) {
  Image image{grey.cols, grey.rows, {}};
  image.pixels.reserve(grey.total());
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x)
      image.pixels.push_back(
          static_cast<std::uint8_t>(std::lround(std::clamp(grey.at<double>(y, x), 0.0, 255.0))));
  return image;
}

Image through_jpeg(const Image& image, int quality) {
  if (quality <= 0) return image;
  const cv::Mat pixels(image.height, image.width, CV_8U,
                       const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", pixels, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  const cv::Mat decoded = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
  return {image.width, image.height, {decoded.datastart, decoded.dataend}};
}

}  // namespace edgescout
