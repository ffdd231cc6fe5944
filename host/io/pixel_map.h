// Internal to host/io: where the pixels of an undistorted image lie in the original.
#pragma once

#include <opencv2/core.hpp>

#include "host/core/camera.h"

namespace edgescout {

// For every pixel of undistorted(camera) the place in the camera's own image, float px.
struct PixelMap {
  cv::Mat x, y;
};

PixelMap map_to_original(const Camera& camera);

}  // namespace edgescout
