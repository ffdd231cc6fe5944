#include "host/track/reduced_image.h"

#include <opencv2/imgproc.hpp>

namespace edgescout {

Image reduced(const Image& image, int factor) {
  Image small{image.width / factor, image.height / factor, {}};
  small.pixels.resize(std::size_t(small.width) * small.height);
  const cv::Mat all(image.height, image.width, CV_8U,
                    const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat into(small.height, small.width, CV_8U, small.pixels.data());
  cv::resize(all(cv::Rect(0, 0, factor * small.width, factor * small.height)), into, into.size(), 0,
             0, cv::INTER_AREA);
  return small;
}

}  // namespace edgescout
