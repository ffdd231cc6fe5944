// Internal to host/io: brings decoded pixels of any kind to one channel.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "host/io/image_options.h"

namespace edgescout {

// InputError naming `source`: a side is shorter than 16 px.
void require_least_size(const cv::Mat& image, const std::string& source);

// A grey image as it is, a colour image by Rec. 601, without its alpha, and a mosaic of the pattern
// with its colours interpolated. The depth stays. A conversion of colours is logged once.
// InputError naming `source`: another number of channels; a mosaic in colour or of real numbers.
cv::Mat to_grey(const cv::Mat& image, BayerPattern bayer, const std::string& source);

}  // namespace edgescout
