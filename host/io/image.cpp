#include "host/io/image.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <climits>
#include <new>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "host/core/lens.h"
#include "host/core/log.h"
#include "host/io/exif.h"
#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr int min_side_px = 16;
constexpr int max_distorted_side_px = SHRT_MAX - 1;  // of cv::remap

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// Decoders fill the missing rest of a truncated image with grey and only warn. So the end marks of
// the two common formats are checked here.
bool is_cut_short(const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) return bytes.find("IEND") == std::string::npos;
  if (!bytes.starts_with("\xff\xd8")) return false;
  // Coded data never holds these two-byte marks, and an embedded thumbnail ends before the scan
  // starts.
  const std::size_t end = bytes.rfind("\xff\xd9"), scan = bytes.rfind("\xff\xda");
  return end == std::string::npos || (scan != std::string::npos && end < scan);
}

// OpenCV has its own error for it.
bool is_out_of_memory(const std::exception& error) {
  const auto* of_opencv = dynamic_cast<const cv::Exception*>(&error);
  return (of_opencv && of_opencv->code == cv::Error::StsNoMem) ||
         dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
}

cv::Mat decode(const std::string& bytes, const std::string& source) {
  const InputError not_an_image(source, "image", "data that no image decoder accepts",
                                "a PNG, JPEG or other image");
  if (bytes.empty())
    throw InputError(source, "image", "an empty file", "a PNG, JPEG or other image");
  if (is_cut_short(bytes)) throw InputError(source, "image", "a file cut short", "a whole image");
  cv::Mat image;
  try {
    const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    image = cv::imdecode(view, cv::IMREAD_UNCHANGED);
  } catch (const std::exception& error) {  // cv::Exception for absurd sizes
    if (is_out_of_memory(error))
      throw InputError(source, "image", "more pixels than there is memory for", "one that fits");
    throw not_an_image;
  }
  if (image.empty()) throw not_an_image;
  return image;
}

cv::Mat to_grey(const cv::Mat& image, const std::string& source) {
  if (image.depth() != CV_8U && image.depth() != CV_16U)
    throw InputError(source, "bit depth", std::to_string(8 * image.elemSize1()) + " bit a channel",
                     "8 or 16 bit");
  if (image.channels() == 1) return image;
  if (image.channels() != 3 && image.channels() != 4)
    throw InputError(source, "channels", std::to_string(image.channels()),
                     "1 (grey), 3 or 4 (colour)");
  static std::atomic_flag was_logged;
  if (!was_logged.test_and_set())
    log(LogLevel::Info,
        source + ": colour image converted to grey (not repeated for further images)");
  cv::Mat grey;
  cv::cvtColor(image, grey, image.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  return grey;
}

// The values at which so many of a million pixels are darker, and so many brighter. Outliers, such
// as dead and hot pixels, do not count.
std::pair<int, int> robust_range(const cv::Mat& grey) {
  constexpr std::size_t left_out_per_million = 1000;
  std::vector<std::size_t> counts(1 << 16);
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) ++counts[grey.at<std::uint16_t>(y, x)];
  const std::size_t left_out = grey.total() * left_out_per_million / 1'000'000;
  std::size_t low = 0, high = counts.size() - 1;
  for (std::size_t below = counts[low]; below <= left_out && low < high;) below += counts[++low];
  for (std::size_t above = counts[high]; above <= left_out && high > low;) above += counts[--high];
  return {static_cast<int>(low), static_cast<int>(high)};
}

// Sensors of 10 to 16 bit fill any part of the range. An image scaled by its own values gives the
// thresholds of edges the same meaning whatever that part is. Steps are never enlarged.
cv::Mat to_8_bit(const cv::Mat& grey, const std::string& source) {
  const auto [low, high] = robust_range(grey);
  const double scale = 255.0 / std::max(high - low, 255);
  cv::Mat scaled;
  grey.convertTo(scaled, CV_8U, scale, -scale * low);
  static std::atomic_flag was_logged;
  if (!was_logged.test_and_set())
    log(LogLevel::Info, source + ": 16 bit scaled to 8 bit, " + std::to_string(low) + " to " +
                            std::to_string(high) +
                            " becomes black to white (not repeated for further images)");
  return scaled;
}

void mention_orientation(const std::string& bytes, const std::string& source) {
  static std::atomic_flag was_logged;
  const int orientation = exif_orientation(bytes);
  if (orientation != 1 && !was_logged.test_and_set())
    log(LogLevel::Warning, source + ": EXIF orientation: found " + std::to_string(orientation) +
                               ", expected 1: the pixels are used as they are stored, and the "
                               "calibration must be of these (not repeated for further images)");
}

Image from_mat(const cv::Mat& grey) {
  Image image{grey.cols, grey.rows, {}};
  image.pixels.reserve(grey.total());
  for (int y = 0; y < grey.rows; ++y)
    image.pixels.insert(image.pixels.end(), grey.ptr<std::uint8_t>(y),
                        grey.ptr<std::uint8_t>(y) + grey.cols);
  return image;
}

// An image may come from a caller's own program.
void require_all_pixels(const Image& image) {
  const std::size_t expected =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.pixels.size() != expected)
    throw InputError("image", "pixels", std::to_string(image.pixels.size()),
                     std::to_string(expected) + " of " + size_text(image.width, image.height));
}

cv::Matx33d matrix_of(const Camera& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

// For every pixel of the undistorted image the place in the original.
struct PixelMap {
  cv::Mat x, y;
};

PixelMap map_by_opencv(const Camera& camera) {
  PixelMap map;
  const int count = static_cast<int>(camera.distortion.size());
  const cv::Mat distortion(1, count, CV_64F, const_cast<double*>(camera.distortion.data()));
  cv::initUndistortRectifyMap(matrix_of(camera), distortion, cv::noArray(),
                              matrix_of(undistorted(camera)), {camera.width, camera.height},
                              CV_32FC1, map.x, map.y);
  return map;
}

// OpenCV has neither all of the models nor a skew.
PixelMap map_by_lens(const Camera& camera) {
  const Camera ideal = undistorted(camera);
  PixelMap map{cv::Mat(camera.height, camera.width, CV_32FC1),
               cv::Mat(camera.height, camera.width, CV_32FC1)};
  cv::parallel_for_({0, camera.height}, [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row)
      for (int column = 0; column < camera.width; ++column) {
        const Eigen::Vector3d ray = ray_through(ideal, {column, row});
        const Eigen::Vector2d seen = pixel_seeing(camera, ray.head<2>());
        map.x.at<float>(row, column) = static_cast<float>(seen.x());
        map.y.at<float>(row, column) = static_cast<float>(seen.y());
      }
  });
  return map;
}

PixelMap map_to_original(const Camera& camera) {
  return camera.lens == LensModel::BrownConrady && camera.skew == 0 ? map_by_opencv(camera)
                                                                    : map_by_lens(camera);
}

std::string png_of(const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

bool has_image_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return char(std::tolower(c)); });
  static const std::set<std::string> known{".png", ".jpg", ".jpeg", ".pgm",
                                           ".ppm", ".bmp", ".tif",  ".tiff"};
  return known.contains(extension);
}

Image load_image(const std::filesystem::path& file) {
  const std::string source = file.string();
  const std::string bytes = read_file(file);
  cv::Mat image = to_grey(decode(bytes, source), source);
  mention_orientation(bytes, source);
  if (image.depth() == CV_16U) image = to_8_bit(image, source);
  if (image.cols < min_side_px || image.rows < min_side_px)
    throw InputError(source, "image size", size_text(image.cols, image.rows), "at least 16x16 px");
  return from_mat(image);
}

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
