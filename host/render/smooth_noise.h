// Random fields over an image.
#pragma once

#include <opencv2/core.hpp>

#include "host/core/random.h"

namespace edgescout {

// CV_32F. Each pixel has mean 0 and variance 1 (near the border a little more); neighbours are
// alike over about `blur_px`. 0: all pixels are independent.
cv::Mat smooth_noise(cv::Size size, double blur_px, const Random& random);

}  // namespace edgescout
