// An image of every grey level, in the values of any type.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "host/io/image.h"

namespace edgescout::test {

// Every level from left to right, times `scale`, plus `offset`.
inline cv::Mat ramp(int type, double scale, double offset = 0) {
  cv::Mat grey(50, 256, CV_8U), deep;
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x);
  grey.convertTo(deep, type, scale, offset);
  return deep;
}

// Whether the levels are those of ramp(CV_8U, 1).
inline void expect_ramp(const Image& image, double tolerance, const std::string& what) {
  for (int x = 0; x < image.width; ++x) EXPECT_NEAR(image.at(x, 10), x, tolerance) << what;
}

}  // namespace edgescout::test
