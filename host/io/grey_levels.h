// Internal to host/io: brings images of any depth to 8 bit.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "host/io/image_options.h"

namespace edgescout {

// An image of one channel, of any type, as 8 bit. One of 8 bit changes only by
// ImageOptions::black_white. What is not a number becomes black. What was done is logged once.
// InputError naming `source`: no pixel is finite.
cv::Mat to_8_bit(const cv::Mat& grey, const ImageOptions& options, const std::string& source);

}  // namespace edgescout
