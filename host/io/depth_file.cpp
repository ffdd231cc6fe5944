#include "host/io/depth_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "host/core/option_names.h"
#include "host/core/quantile.h"
#include "host/io/decode_pixels.h"
#include "host/io/pixel_rows.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr char in_memory[] = "depth image";

// Of the values that say anything; 0 where there are none.
double median_of_stored(const cv::Mat& stored) {
  std::vector<float> values;
  for (int y = 0; y < stored.rows; ++y)
    for (int x = 0; x < stored.cols; ++x) {
      const float value = stored.at<float>(y, x);
      if (std::isfinite(value) && value != 0) values.push_back(value);
    }
  return double(upper_median(std::move(values)));
}

[[noreturn]] void fail_without_depth(double median, double unit_m, const DepthOptions& o,
                                     const std::string& source) {
  throw InputError(
      source, "values",
      fmt::format("around {:.6g}, which are {:.6g} m in units of {:.6g} m", median, median * unit_m,
                  unit_m),
      fmt::format("depth from {:.6g} to {:.6g} m ({}, {})", o.range_m.low, o.range_m.high,
                  option_name("depth-unit"), option_name("depth-range")));
}

// `stored` has one channel.
DepthImage in_metres(const cv::Mat& stored, const std::string& source, const DepthOptions& options,
                     std::optional<double> stated_m) {
  options.validate();
  const bool is_real = stored.depth() == CV_32F || stored.depth() == CV_64F;
  const double unit_m =
      options.unit_m > 0 ? options.unit_m : stated_m.value_or(is_real ? 1.0 : 1e-3);
  cv::Mat values;
  stored.convertTo(values, CV_32F);
  DepthImage depth{stored.cols, stored.rows, {}};
  depth.z_m.reserve(stored.total());
  bool has_any = false;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x) {
      const double z_m = double(values.at<float>(y, x)) * unit_m;
      const bool is_measured = z_m >= options.range_m.low && z_m <= options.range_m.high && z_m > 0;
      has_any |= is_measured;
      depth.z_m.push_back(is_measured ? float(z_m) : DEPTH_MISSING);
    }
  if (has_any) return depth;
  if (const double median = median_of_stored(values); median != 0)
    fail_without_depth(median, unit_m, options, source);
  return depth;
}

template <typename Value>
DepthImage of_memory(std::span<const Value> values, int width, int height, int type,
                     const DepthOptions& options, std::optional<double> stated_m) {
  if (width < 1 || height < 1 || values.size() != std::size_t(width) * std::size_t(height))
    throw InputError(in_memory, "values", std::to_string(values.size()),
                     fmt::format("those of {}x{}", width, height));
  return in_metres(cv::Mat(height, width, type, const_cast<Value*>(values.data())), in_memory,
                   options, stated_m);
}

}  // namespace

DepthImage load_depth(const std::filesystem::path& file, const DepthOptions& options,
                      std::optional<double> stated_m) {
  return decode_depth(read_image_bytes(file), file.string(), options, stated_m);
}

DepthImage decode_depth(const std::string& bytes, const std::string& source,
                        const DepthOptions& options, std::optional<double> stated_m) {
  const cv::Mat stored = decode_pixels(bytes, {}, source);
  if (stored.channels() != 1)
    throw InputError(source, "depth", fmt::format("{} channels", stored.channels()), "one");
  if (stored.depth() == CV_8U || stored.depth() == CV_8S)
    throw InputError(source, "depth", "8 bit a pixel",
                     "16 bit or real numbers: 8 bit is a picture of depth");
  return in_metres(stored, source, options, stated_m);
}

DepthImage depth_image(std::span<const std::uint16_t> values, int width, int height,
                       const DepthOptions& options, std::optional<double> stated_m) {
  return of_memory(values, width, height, CV_16U, options, stated_m);
}

DepthImage depth_image(std::span<const float> values, int width, int height,
                       const DepthOptions& options, std::optional<double> stated_m) {
  return of_memory(values, width, height, CV_32F, options, stated_m);
}

DepthImage depth_image(const Pixels& pixels, const DepthOptions& options,
                       const std::string& source) {
  if (pixels.format != PixelFormat::Mono16 && pixels.format != PixelFormat::MonoUint32 &&
      pixels.format != PixelFormat::MonoFloat32)
    throw InputError(source, "format", "a picture",
                     "distances: whole numbers of 16 or 32 bit or real numbers");
  return in_metres(pixel_rows(pixels, source), source, options, {});
}

}  // namespace edgescout
