// Reads image files of every kind that OpenCV decodes.
#include <algorithm>
#include <atomic>
#include <cctype>
#include <fstream>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "host/core/log.h"
#include "host/core/option_names.h"
#include "host/io/exif.h"
#include "host/io/files.h"
#include "host/io/from_mat.h"
#include "host/io/grey_levels.h"
#include "host/io/image.h"
#include "host/io/image_header.h"
#include "host/io/to_grey.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::uintmax_t max_bytes = 1u << 31;  // OpenCV counts them in an int
std::string an_image() {
  return "a PNG, JPEG or other image (" + option_name("raw-size") + " reads one without a header)";
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

// What a decoder says that is off by default is of use: it names what switches it on.
std::string reason_of(const std::exception& error) {
  const auto* of_opencv = dynamic_cast<const cv::Exception*>(&error);
  if (of_opencv && of_opencv->err.find("OPENCV_IO_ENABLE") != std::string::npos)
    return "a format that is off: " + of_opencv->err;
  return "data that no image decoder accepts";
}

cv::Mat decode(const std::string& bytes, const std::string& source) {
  std::string found = "data that no image decoder accepts";
  cv::Mat image;
  try {
    const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    // A grey Sun raster decodes to black pixels, unless colours are asked for.
    const bool is_sun_raster = bytes.starts_with("\x59\xa6\x6a\x95");
    image = cv::imdecode(view, is_sun_raster ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED);
  } catch (const std::exception& error) {
    if (is_out_of_memory(error))
      throw InputError(source, "image", "more pixels than there is memory for", "one that fits");
    found = reason_of(error);
  }
  if (image.empty()) throw InputError(source, "image", found, an_image());
  return image;
}

// Pixels by row, of one byte or of two with the lower one first, and nothing else.
cv::Mat raw_image(const std::string& bytes, const ImageOptions& options,
                  const std::string& source) {
  const StatedSize size{static_cast<std::uint64_t>(options.raw_size_px[0]),
                        static_cast<std::uint64_t>(options.raw_size_px[1])};
  require_size(size, source);
  const std::size_t pixels = size.width * size.height;
  if (bytes.size() != pixels && bytes.size() != 2 * pixels)
    throw InputError(source, "file size", std::to_string(bytes.size()) + " bytes",
                     std::to_string(pixels) + " or " + std::to_string(2 * pixels) +
                         " for pixels of " + text_of_size(size) + " (" + option_name("raw-size") +
                         ")");
  const int type = bytes.size() == pixels ? CV_8U : CV_16U;
  return cv::Mat(static_cast<int>(size.height), static_cast<int>(size.width), type,
                 const_cast<char*>(bytes.data()))
      .clone();
}

cv::Mat pixels_of(const std::string& bytes, const ImageOptions& options,
                  const std::string& source) {
  if (bytes.empty()) throw InputError(source, "image", "an empty file", an_image());
  if (!begins_as_image(bytes) && !options.raw_size_px.empty())
    return raw_image(bytes, options, source);
  const std::optional<StatedSize> size = stated_size(bytes);
  if (is_cut_short(bytes)) throw InputError(source, "image", "a file cut short", "a whole image");
  if (size) require_size(*size, source);
  return decode(bytes, source);
}

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

std::string read_bytes_of(const std::filesystem::path& file) {
  std::error_code unknown;  // reading the file reports the error
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  if (!unknown && bytes >= max_bytes)
    throw InputError(file.string(), "file size", std::to_string(bytes) + " bytes",
                     "less than " + std::to_string(max_bytes));
  return read_file(file);
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
  return decode_image(read_bytes_of(file), file.string(), options);
}

Image decode_image(const std::string& bytes, const std::string& source,
                   const ImageOptions& options) {
  if (bytes.size() >= max_bytes)
    throw InputError(source, "image", std::to_string(bytes.size()) + " bytes",
                     "less than " + std::to_string(max_bytes));
  const cv::Mat pixels = pixels_of(bytes, options, source);
  require_least_size(pixels, source);
  mention_orientation(bytes, source);
  mention_pages(bytes, source);
  return from_mat(to_8_bit(to_grey(pixels, options.bayer, source), options, source));
}

}  // namespace edgescout
