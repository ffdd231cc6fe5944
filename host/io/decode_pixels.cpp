#include "host/io/decode_pixels.h"

#include <cstdint>
#include <new>
#include <opencv2/imgcodecs.hpp>

#include "host/core/option_names.h"
#include "host/io/exif.h"
#include "host/io/files.h"
#include "host/io/image_header.h"
#include "host/io/png_chunks.h"
#include "host/io/tiff_header.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::uintmax_t max_bytes = 1u << 31;  // OpenCV counts them in an int

std::string an_image() {
  return "a PNG, JPEG or other image (" + option_name("raw-size") + " reads one without a header)";
}

bool is_png(const std::string& bytes) { return bytes.starts_with("\x89PNG"); }

// Decoders fill the missing rest of a truncated image with grey and only warn. So the size of files
// without compression and the end mark of JPEG are checked here.
bool is_cut_short(const std::string& bytes) {
  if (bytes.size() < stated_bytes(bytes)) return true;
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

}  // namespace

std::string read_image_bytes(const std::filesystem::path& file) {
  std::error_code unknown;  // reading the file reports the error
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  if (!unknown && bytes >= max_bytes)
    throw InputError(file.string(), "file size", std::to_string(bytes) + " bytes",
                     "less than " + std::to_string(max_bytes));
  return read_file(file);
}

cv::Mat decode_pixels(const std::string& bytes, const ImageOptions& options,
                      const std::string& source) {
  if (bytes.size() >= max_bytes)
    throw InputError(source, "image", std::to_string(bytes.size()) + " bytes",
                     "less than " + std::to_string(max_bytes));
  if (bytes.empty()) throw InputError(source, "image", "an empty file", an_image());
  if (!begins_as_image(bytes) && !options.raw_size_px.empty())
    return raw_image(bytes, options, source);
  const std::optional<StatedSize> size = stated_size(bytes);
  if (size) require_size(*size, source);
  if (is_cut_short(bytes)) throw InputError(source, "image", "a file cut short", "a whole image");
  if (const std::string found = undecodable(bytes); !found.empty())
    throw InputError(source, "image", found, an_image());
  if (is_png(bytes)) return decode(needed_png_chunks(bytes, source), source);
  return decode(exif_orientation(bytes) == 1 ? bytes : as_stored(bytes), source);
}

}  // namespace edgescout
