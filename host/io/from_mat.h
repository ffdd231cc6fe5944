// Internal to host/io: the project's image of OpenCV's.
#pragma once

#include <opencv2/core.hpp>

#include "host/core/types.h"

namespace edgescout {

// `grey` has one channel of 8 bit.
inline Image from_mat(const cv::Mat& grey) {
  Image image{grey.cols, grey.rows, {}};
  image.pixels.reserve(grey.total());
  for (int y = 0; y < grey.rows; ++y)
    image.pixels.insert(image.pixels.end(), grey.ptr<std::uint8_t>(y),
                        grey.ptr<std::uint8_t>(y) + grey.cols);
  return image;
}

}  // namespace edgescout
