#include "host/io/image.h"

#include <algorithm>
#include <climits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "host/io/files.h"
#include "host/io/from_mat.h"
#include "host/io/pixel_map.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr int max_distorted_side_px = SHRT_MAX - 1;  // of cv::remap

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// An image may come from a caller's own program.
void require_all_pixels(const Image& image) {
  const std::size_t expected =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.pixels.size() != expected)
    throw InputError("image", "pixels", std::to_string(image.pixels.size()),
                     std::to_string(expected) + " of " + size_text(image.width, image.height));
}

std::string png_of(const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Image undistort(const Image& image, const Camera& camera) {
  check(image.width == camera.width && image.height == camera.height,
        "undistort: image and camera differ in size");
  require_all_pixels(image);
  if (!camera.has_distortion()) return image;
  if (std::max(image.width, image.height) > max_distorted_side_px)
    throw InputError("image", "size", size_text(image.width, image.height),
                     "sides of at most " + std::to_string(max_distorted_side_px) +
                         " px where a lens distortion is taken out");
  const cv::Mat source(image.height, image.width, CV_8U,
                       const_cast<std::uint8_t*>(image.pixels.data()));
  const PixelMap map = map_to_original(camera);
  cv::Mat result;
  cv::remap(source, result, map.x, map.y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return from_mat(result);
}

std::string encode_png(const RgbImage& image) {
  check(image.pixels.size() == std::size_t{3} * image.width * image.height,
        "encode_png: pixel count");
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return png_of(bgr);
}

std::string encode_png(const Image& image) {
  check(image.pixels.size() == std::size_t{1} * image.width * image.height,
        "encode_png: pixel count");
  return png_of(
      cv::Mat(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data())));
}

void save_png(const RgbImage& image, const std::filesystem::path& file) {
  write_file_atomically(file, encode_png(image));
}

void save_png(const Image& image, const std::filesystem::path& file) {
  write_file_atomically(file, encode_png(image));
}

}  // namespace edgescout
