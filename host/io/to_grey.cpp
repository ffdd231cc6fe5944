#include "host/io/to_grey.h"

#include <atomic>
#include <opencv2/imgproc.hpp>

#include "host/core/log.h"
#include "host/core/option_names.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

int code_of(BayerPattern bayer) {
  switch (bayer) {
    case BayerPattern::RGGB:
      return cv::COLOR_BayerRGGB2GRAY;
    case BayerPattern::BGGR:
      return cv::COLOR_BayerBGGR2GRAY;
    case BayerPattern::GRBG:
      return cv::COLOR_BayerGRBG2GRAY;
    case BayerPattern::GBRG:
      return cv::COLOR_BayerGBRG2GRAY;
    case BayerPattern::None:
      break;
  }
  throw LogicError("to_grey: no pattern");
}

cv::Mat grey_of_mosaic(const cv::Mat& mosaic, BayerPattern bayer, const std::string& source) {
  if (mosaic.channels() != 1)
    throw InputError(source, "channels", std::to_string(mosaic.channels()),
                     "1 with " + option_name("bayer"));
  if (mosaic.depth() != CV_8U && mosaic.depth() != CV_16U)
    throw InputError(source, "bit depth", "real or signed numbers",
                     "8 or 16 bit with " + option_name("bayer"));
  cv::Mat grey;
  cv::cvtColor(mosaic, grey, code_of(bayer));
  return grey;
}

}  // namespace

void require_least_size(const cv::Mat& image, const std::string& source) {
  constexpr int min_side_px = 16;
  if (image.cols < min_side_px || image.rows < min_side_px)
    throw InputError(source, "image size",
                     std::to_string(image.cols) + "x" + std::to_string(image.rows),
                     "at least 16x16 px");
}

cv::Mat to_grey(const cv::Mat& image, BayerPattern bayer, const std::string& source) {
  if (bayer != BayerPattern::None) return grey_of_mosaic(image, bayer, source);
  if (image.channels() == 1) return image;
  if (image.channels() != 3 && image.channels() != 4)
    throw InputError(source, "channels", std::to_string(image.channels()),
                     "1 (grey), 3 or 4 (colour)");
  static std::atomic_flag was_logged;
  if (!was_logged.test_and_set())
    log(LogLevel::Info,
        source + ": colour image converted to grey (not repeated for further images)");
  cv::Mat colour = image, grey;
  // The types that OpenCV converts.
  if (image.depth() != CV_8U && image.depth() != CV_16U) image.convertTo(colour, CV_32F);
  cv::cvtColor(colour, grey, image.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  return grey;
}

}  // namespace edgescout
