#include "host/io/grey_levels.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "host/core/log.h"
#include "host/core/option_names.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// What an image of little contrast is brought to: the median of 57 images of 8 bit, rendered and
// photographed, between the same quantiles. A wider range finds more noise, a narrower one fewer
// edges: with 255 grey levels for an image that has 195, 59 % more edge points are found.
constexpr double usual_contrast = 235;
constexpr double usual_black = 10;
// Less of the sensor's range than this is little contrast.
constexpr double least_share = 0.25;

// The values below and above which a thousandth of the pixels lie. Outliers, such as dead and hot
// pixels, do not count.
Range robust_range(const cv::Mat& grey, const std::string& source) {
  constexpr std::size_t per = 1000;
  std::vector<float> values;
  values.reserve(grey.total());
  for (const float value : cv::Mat_<float>(grey))
    if (std::isfinite(value)) values.push_back(value);
  if (values.empty()) throw InputError(source, "pixels", "none that is finite", "grey values");
  const auto left_out = static_cast<std::ptrdiff_t>(values.size() / per);
  const auto low = values.begin() + left_out, high = values.end() - 1 - left_out;
  std::nth_element(values.begin(), low, values.end());
  if (low < high) std::nth_element(low + 1, high, values.end());
  return {*low, *high};
}

// Hot pixels of a sensor of fewer bits, up to a hundredth of all, have the largest value of the
// type, and hardly a pixel has a value between. They are more than the outliers of robust_range.
Range without_hot_pixels(const Range& robust, const cv::Mat& grey, double largest,
                         const std::string& source) {
  constexpr double most = 0.01;
  const cv::Mat is_hot = grey == largest;
  const int hot = cv::countNonZero(is_hot);
  if (robust.high < largest || hot > most * double(grey.total())) return robust;
  cv::Mat others = grey.clone();
  others.setTo(std::nan(""), is_hot);
  const Range range = robust_range(others, source);
  return range.high <= (1 << 14) - 1 ? range : robust;
}

bool is_real(int depth) { return depth == CV_32F || depth == CV_64F; }

// White of the least deep sensor whose values these may be: 8, 10, 12, 14 or 16 bit, or 1 of real
// numbers. 0: none.
double white_of_sensor(double brightest, bool real) {
  if (real && brightest <= 1) return 1;
  for (int bits = 8; bits <= 16; bits += 2)
    if (brightest <= (1 << bits) - 1) return (1 << bits) - 1;
  return 0;
}

Range full_range(int depth) {
  switch (depth) {
    case CV_8S:
      return {0, 127};
    case CV_16U:
      return {0, 65535};
    case CV_16S:
      return {0, 32767};
    case CV_32S:
      return {0, 2147483647};
    default:
      return {0, 1};
  }
}

// The thresholds of edges are differences of grey levels. The sensor's own range gives an image
// the edges that its 8-bit version has, exactly. Where the image fills little of it, as with an
// offset, its own range is the better guess. Whole steps are not enlarged: they may be noise.
Range chosen_range(const Range& robust, int depth) {
  const bool real = is_real(depth);
  double white = white_of_sensor(robust.high, real);
  if (!real) white = std::min(white, full_range(depth).high);
  const double span = robust.high - robust.low;
  if (robust.low >= 0 && white > 0 && span >= least_share * white) return {0, white};
  const double largest = std::max(std::abs(robust.low), std::abs(robust.high));
  const double least_span =
      real ? std::max(largest, 1e-30) * usual_contrast / 65535 : usual_contrast;
  const double level = std::max(span, least_span) / usual_contrast;
  const double black = robust.low - usual_black * level;
  return {black, black + 255 * level};
}

Range range_of(const cv::Mat& grey, int depth, const ImageOptions& options,
               const std::string& source) {
  if (!options.black_white.empty()) return {options.black_white[0], options.black_white[1]};
  if (options.scaling == GreyScaling::Full) return full_range(depth);
  Range robust = robust_range(grey, source);
  if (options.scaling == GreyScaling::Auto) {
    if (depth == CV_16U) robust = without_hot_pixels(robust, grey, full_range(depth).high, source);
    return chosen_range(robust, depth);
  }
  return {robust.low, std::max(robust.high, std::nextafter(float(robust.low), INFINITY) + 0.0)};
}

// Beyond white, not a number: OpenCV converts neither to a defined value.
void keep_within(cv::Mat& grey, const Range& range) {
  for (float& value : cv::Mat_<float>(grey))
    value = std::isnan(value) ? float(range.low)
                              : std::clamp(value, float(range.low), float(range.high));
}

std::string text_of_number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

void mention(const cv::Mat& grey, const Range& range, const std::string& source) {
  static std::atomic_flag was_logged;
  if (!was_logged.test_and_set())
    log(LogLevel::Info, source + ": scaled to 8 bit: " + text_of_number(range.low) + " to " +
                            text_of_number(range.high) +
                            " becomes black to white (not repeated for further images; " +
                            option_name("image-range") + " sets it)");
  const auto unusable = std::count_if(grey.begin<float>(), grey.end<float>(),
                                      [](float value) { return !std::isfinite(value); });
  static std::atomic_flag was_warned;
  if (unusable > 0 && !was_warned.test_and_set())
    log(LogLevel::Warning, source + ": pixels: found " + std::to_string(unusable) +
                               " that are not finite, expected none: they become black or white "
                               "(not repeated for further images)");
}

}  // namespace

cv::Mat to_8_bit(const cv::Mat& grey, const ImageOptions& options, const std::string& source) {
  if (grey.depth() == CV_8U && options.black_white.empty()) return grey;
  cv::Mat values, scaled;
  grey.convertTo(values, CV_32F);
  const Range range = range_of(values, grey.depth(), options, source);
  mention(values, range, source);
  keep_within(values, range);
  const double scale = 255 / (range.high - range.low);
  values.convertTo(scaled, CV_8U, scale, -scale * range.low);
  return scaled;
}

}  // namespace edgescout
