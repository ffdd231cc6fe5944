// Light that several tests share.
#pragma once

#include <opencv2/core.hpp>

#include "host/render/environment.h"

namespace edgescout::test {

// The same light in all pixels of an image.
inline cv::Mat even_light(int width, int height, double light) {
  return {height, width, CV_32F, cv::Scalar::all(light)};
}

// Three times as much far light from the east, x > 0.
inline FarLight bright_east() {
  return [](const Eigen::Vector3d& direction) { return direction.x() > 0 ? 3.0 : 1.0; };
}

}  // namespace edgescout::test
