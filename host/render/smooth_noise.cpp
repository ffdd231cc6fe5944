#include "host/render/smooth_noise.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace edgescout {

cv::Mat smooth_noise(cv::Size size, double blur_px, const Random& random) {
  cv::Mat noise(size, CV_32F);
  for (int y = 0; y < size.height; ++y) {
    Random row = random.split(static_cast<std::uint64_t>(y));
    for (int x = 0; x < size.width; ++x) noise.at<float>(y, x) = static_cast<float>(row.normal());
  }
  if (blur_px <= 0) return noise;
  const int side = 2 * static_cast<int>(std::ceil(3 * blur_px)) + 1;
  const cv::Mat weights = cv::getGaussianKernel(side, blur_px, CV_64F);
  cv::Mat smooth;
  cv::sepFilter2D(noise, smooth, CV_32F, weights, weights, {-1, -1}, 0, cv::BORDER_REFLECT_101);
  return smooth / weights.dot(weights);  // the variance of a sum with independent summands
}

}  // namespace edgescout
