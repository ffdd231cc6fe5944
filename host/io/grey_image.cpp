#include <bit>
#include <opencv2/imgproc.hpp>

#include "host/io/from_mat.h"
#include "host/io/grey_levels.h"
#include "host/io/image.h"
#include "host/io/to_grey.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

template <typename Value>
Image grey_image_of(std::span<const Value> values, int width, int height,
                    const ImageOptions& options) {
  options.validate();
  if (width < 1 || height < 1 || values.size() != std::size_t(width) * std::size_t(height))
    throw InputError("image", "values", std::to_string(values.size()),
                     std::to_string(width) + "x" + std::to_string(height));
  const cv::Mat grey(height, width, cv::traits::Type<Value>::value,
                     const_cast<Value*>(values.data()));
  return from_mat(to_8_bit(grey, options, "image"));
}

void require_rows(std::size_t bytes, const PixelLayout& layout, const std::string& source) {
  constexpr int longest_side_px = 1 << 15;  // OpenCV counts the bytes of an image in an int
  if (layout.width < 1 || layout.height < 1 || layout.width > longest_side_px ||
      layout.height > longest_side_px)
    throw InputError(source, "image size",
                     std::to_string(layout.width) + "x" + std::to_string(layout.height),
                     "sides of 1 to " + std::to_string(longest_side_px));
  if (layout.channels < 1 || layout.channels > 4 || layout.channel_bytes < 1 ||
      layout.channel_bytes > 2)
    throw InputError(source, "pixels",
                     std::to_string(layout.channels) + " channels of " +
                         std::to_string(layout.channel_bytes) + " bytes",
                     "1 to 4 channels of 1 or 2 bytes");
  const auto pixel = std::size_t(layout.channels) * std::size_t(layout.channel_bytes);
  const std::size_t row = std::size_t(layout.width) * pixel;
  if (layout.row_bytes < row || layout.row_bytes % std::size_t(layout.channel_bytes) != 0)
    throw InputError(source, "step", std::to_string(layout.row_bytes) + " bytes a row",
                     "at least " + std::to_string(row) + ", of whole values");
  const std::size_t rows = std::size_t(layout.height);
  const std::size_t least = layout.row_bytes * (rows - 1) + row, most = layout.row_bytes * rows;
  if (bytes < least || bytes > most)
    throw InputError(source, "data", std::to_string(bytes) + " bytes",
                     std::to_string(most) + " for " + std::to_string(layout.width) + "x" +
                         std::to_string(layout.height) + " px");
}

// A copy whose 16-bit values have this machine's order of bytes.
cv::Mat with_own_bytes(const cv::Mat& pixels) {
  cv::Mat swapped = pixels.clone();
  const std::size_t row = std::size_t(swapped.cols) * std::size_t(swapped.channels());
  for (int y = 0; y < swapped.rows; ++y) {
    auto* value = swapped.ptr<std::uint16_t>(y);
    for (std::size_t i = 0; i < row; ++i) value[i] = std::uint16_t(value[i] << 8 | value[i] >> 8);
  }
  return swapped;
}

// In the order of channels that to_grey takes.
cv::Mat in_usual_order(const cv::Mat& pixels, const PixelLayout& layout) {
  cv::Mat ordered = pixels;
  if (layout.channels == 2) cv::extractChannel(pixels, ordered, layout.is_luma_first ? 0 : 1);
  if (layout.channels == 3 && layout.is_red_first) cv::cvtColor(pixels, ordered, cv::COLOR_RGB2BGR);
  if (layout.channels == 4 && layout.is_red_first)
    cv::cvtColor(pixels, ordered, cv::COLOR_RGBA2BGRA);
  return ordered;
}

}  // namespace

Image grey_image(std::span<const std::uint8_t> bytes, const PixelLayout& layout,
                 const std::string& source, const ImageOptions& options) {
  options.validate();
  require_rows(bytes.size(), layout, source);
  const int type = CV_MAKETYPE(layout.channel_bytes == 1 ? CV_8U : CV_16U, layout.channels);
  cv::Mat pixels(layout.height, layout.width, type, const_cast<std::uint8_t*>(bytes.data()),
                 layout.row_bytes);
  require_least_size(pixels, source);
  const bool is_big_endian_here = std::endian::native == std::endian::big;
  if (layout.channel_bytes == 2 && layout.is_big_endian != is_big_endian_here)
    pixels = with_own_bytes(pixels);
  const cv::Mat grey = to_grey(in_usual_order(pixels, layout), options.bayer, source);
  return from_mat(to_8_bit(grey, options, source));
}

Image grey_image(std::span<const std::uint16_t> values, int width, int height,
                 const ImageOptions& options) {
  return grey_image_of(values, width, height, options);
}

Image grey_image(std::span<const float> values, int width, int height,
                 const ImageOptions& options) {
  return grey_image_of(values, width, height, options);
}

}  // namespace edgescout
