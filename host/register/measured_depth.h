// The depth image of a view, and how far it can be trusted.
//
// Public header.
#pragma once

#include "host/core/depth_image.h"

namespace edgescout {

struct MeasuredDepth {
  DepthImage image;  // of the view's camera, without distortion (io/depth_registration.h)
  DepthNoise noise;
};

}  // namespace edgescout
