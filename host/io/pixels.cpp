#include "host/io/pixels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "host/io/from_mat.h"
#include "host/io/grey_levels.h"
#include "host/io/image_header.h"
#include "host/io/pixel_rows.h"
#include "host/io/to_grey.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct FormatTraits {
  int type;     // OpenCV's
  int to_grey;  // OpenCV's code of a colour format; -1
  BayerPattern bayer;
};

constexpr std::array<FormatTraits, PIXEL_FORMATS> traits_of_formats{{
    {CV_8UC1, -1, BayerPattern::None},
    {CV_16UC1, -1, BayerPattern::None},
    {CV_32FC1, -1, BayerPattern::None},
    {CV_8UC3, cv::COLOR_BGR2GRAY, BayerPattern::None},
    {CV_8UC3, cv::COLOR_RGB2GRAY, BayerPattern::None},
    {CV_8UC4, cv::COLOR_BGRA2GRAY, BayerPattern::None},
    {CV_8UC4, cv::COLOR_RGBA2GRAY, BayerPattern::None},
    {CV_8UC1, -1, BayerPattern::RGGB},
    {CV_8UC1, -1, BayerPattern::BGGR},
    {CV_8UC1, -1, BayerPattern::GRBG},
    {CV_8UC1, -1, BayerPattern::GBRG},
    {CV_16UC1, -1, BayerPattern::RGGB},
    {CV_16UC1, -1, BayerPattern::BGGR},
    {CV_16UC1, -1, BayerPattern::GRBG},
    {CV_16UC1, -1, BayerPattern::GBRG},
    {CV_16UC3, cv::COLOR_BGR2GRAY, BayerPattern::None},
    {CV_16UC3, cv::COLOR_RGB2GRAY, BayerPattern::None},
    {CV_16UC4, cv::COLOR_BGRA2GRAY, BayerPattern::None},
    {CV_16UC4, cv::COLOR_RGBA2GRAY, BayerPattern::None},
    {CV_8UC2, cv::COLOR_YUV2GRAY_YUY2, BayerPattern::None},
    {CV_8UC2, cv::COLOR_YUV2GRAY_UYVY, BayerPattern::None},
    {CV_32SC1, -1, BayerPattern::None},
}};

const FormatTraits& traits_of(PixelFormat format) {
  check(std::size_t(format) < traits_of_formats.size(), "pixels: no such format");
  return traits_of_formats[std::size_t(format)];
}

void require_pixels(const Pixels& pixels, const std::string& source) {
  if (!pixels.first_row || pixels.width < 1 || pixels.height < 1)
    throw InputError(source, "pixels",
                     pixels.first_row
                         ? std::to_string(pixels.width) + "x" + std::to_string(pixels.height)
                         : "none",
                     "a width and a height of at least 16 px");
  require_size({std::uint64_t(pixels.width), std::uint64_t(pixels.height)}, source);
  const std::ptrdiff_t stride = pixels.row_stride_bytes,
                       row_bytes = std::ptrdiff_t(pixels.width) * bytes_per_pixel(pixels.format);
  constexpr std::ptrdiff_t most = std::ptrdiff_t(1) << 40;
  const bool overlaps = stride != 0 && stride > -row_bytes && stride < row_bytes;
  if (overlaps || stride < -most || stride > most)
    throw InputError(source, "row stride", std::to_string(stride) + " bytes",
                     "at least the " + std::to_string(row_bytes) + " of " +
                         std::to_string(pixels.width) + " pixels, at most 2^40");
}

// Copied row by row: the caller's need not be where their type may stand.
cv::Mat packed(const Pixels& pixels, int type) {
  cv::Mat rows(pixels.height, pixels.width, type);
  const std::size_t row_bytes = std::size_t(pixels.width) * rows.elemSize();
  const std::ptrdiff_t stride =
      pixels.row_stride_bytes != 0 ? pixels.row_stride_bytes : std::ptrdiff_t(row_bytes);
  for (int y = 0; y < rows.rows; ++y)
    std::memcpy(rows.ptr(y), static_cast<const std::byte*>(pixels.first_row) + y * stride,
                row_bytes);
  return rows;
}

void swap_bytes(cv::Mat& rows) {
  const std::size_t size = rows.elemSize1();
  for (uchar *value = rows.data, *end = value + rows.total() * rows.elemSize(); value < end;
       value += size)
    std::reverse(value, value + size);
}

BayerPattern pattern_of(const FormatTraits& format, const ImageOptions& options,
                        const std::string& source) {
  if (options.bayer == BayerPattern::None) return format.bayer;
  if (format.bayer != BayerPattern::None || format.to_grey >= 0)
    throw InputError(source, "format", "colours of its own", "grey pixels with the option bayer");
  return options.bayer;
}

}  // namespace

int bytes_per_pixel(PixelFormat format) { return int(CV_ELEM_SIZE(traits_of(format).type)); }

cv::Mat pixel_rows(const Pixels& pixels, const std::string& source) {
  require_pixels(pixels, source);
  cv::Mat rows = packed(pixels, traits_of(pixels.format).type);
  if (pixels.has_swapped_bytes) swap_bytes(rows);
  return rows;
}

Image grey_image(const Pixels& pixels, const ImageOptions& options, const std::string& source) {
  options.validate();
  const FormatTraits& format = traits_of(pixels.format);
  if (pixels.format == PixelFormat::MonoUint32)
    throw InputError(source, "format", "whole numbers of 32 bit", "a picture: these are distances");
  const BayerPattern bayer = pattern_of(format, options, source);
  cv::Mat image = pixel_rows(pixels, source);
  require_least_size(image, source);
  if (format.to_grey >= 0) {
    cv::Mat grey;
    cv::cvtColor(image, grey, format.to_grey);
    image = grey;
  }
  return from_mat(to_8_bit(to_grey(image, bayer, source), options, source));
}

}  // namespace edgescout
