// A depth image: what a sensor measured of the surfaces before a camera.
//
// Public header.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace edgescout {

inline constexpr float DEPTH_MISSING = 0;  // of a pixel that was not measured

// Row-major, without padding. Values are camera-frame z at the pixels' centres, m: the distance
// along the camera's axis, not along the pixel's ray.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> z_m;  // finite; DEPTH_MISSING or positive
  float at(int x, int y) const { return z_m[static_cast<std::size_t>(y) * width + x]; }
};

// The error of a depth sensor. Structured light and stereo measure disparities, so it grows with
// the distance squared (Khoshelham and Elberink, Sensors 2012).
struct DepthNoise {
  double floor_m = 5e-4;         // standard deviation; the larger of both holds
  double at_one_metre_m = 1e-3;  // at 1 m
  double sigma_m(double z_m) const { return std::max(floor_m, at_one_metre_m * z_m * z_m); }
};

}  // namespace edgescout
