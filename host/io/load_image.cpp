// Reads files of grey images of every kind that OpenCV decodes.
#include <algorithm>
#include <atomic>
#include <cctype>
#include <fstream>
#include <set>

#include "host/core/log.h"
#include "host/io/decode_pixels.h"
#include "host/io/exif.h"
#include "host/io/from_mat.h"
#include "host/io/grey_levels.h"
#include "host/io/image.h"
#include "host/io/image_header.h"
#include "host/io/tiff_header.h"
#include "host/io/to_grey.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

void mention_orientation(const std::string& bytes, const std::string& source) {
  static std::atomic_flag was_logged;
  const int orientation = exif_orientation(bytes);
  if (orientation != 1 && !was_logged.test_and_set())
    log(LogLevel::Warning, source + ": EXIF orientation: found " + std::to_string(orientation) +
                               ", expected 1: the pixels are used as they are stored, and the "
                               "calibration must be of these (not repeated for further images)");
}

void mention_pages(const std::string& bytes, const std::string& source) {
  static std::atomic_flag was_logged;
  if (has_more_pages(bytes) && !was_logged.test_and_set())
    log(LogLevel::Warning, source +
                               ": pages: found several, expected one: the first is used (not "
                               "repeated for further images)");
}

// Larger values become brighter, as its decoder does with 8 bits.
cv::Mat as_brightness(const cv::Mat& pixels, const std::string& bytes) {
  const std::optional<int> black = black_of_inverted(bytes);
  if (!black || pixels.depth() != CV_16U) return pixels;
  return cv::Mat(cv::Scalar(*black) - pixels);
}

// What the file says of white is better than a guess from its pixels.
ImageOptions with_stated_white(ImageOptions options, const std::string& bytes) {
  const std::optional<double> white = stated_white(bytes);
  if (white && options.black_white.empty() && options.scaling == GreyScaling::Auto)
    options.black_white = {0, *white};
  return options;
}

}  // namespace

bool has_image_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return char(std::tolower(c)); });
  static const std::set<std::string> known{
      ".png", ".jpg", ".jpeg", ".jpe", ".jp2", ".bmp", ".dib", ".tif", ".tiff", ".webp", ".exr",
      ".pbm", ".pgm", ".ppm",  ".pnm", ".pam", ".pfm", ".pxm", ".hdr", ".pic",  ".sr",   ".ras"};
  return known.contains(extension);
}

bool is_image_file(const std::filesystem::path& file) {
  if (has_image_extension(file)) return true;
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;
  std::string start(64, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  return begins_as_image(start);
}

Image load_image(const std::filesystem::path& file, const ImageOptions& options) {
  return decode_image(read_image_bytes(file), file.string(), options);
}

Image decode_image(const std::string& bytes, const std::string& source,
                   const ImageOptions& options) {
  const cv::Mat pixels = as_brightness(decode_pixels(bytes, options, source), bytes);
  require_least_size(pixels, source);
  mention_orientation(bytes, source);
  mention_pages(bytes, source);
  return from_mat(
      to_8_bit(to_grey(pixels, options.bayer, source), with_stated_white(options, bytes), source));
}

}  // namespace edgescout
