// An image of real numbers, read between its pixels.
#pragma once

#include <vector>

namespace edgescout {

struct ScalarImage {
  int width = 0;
  int height = 0;
  std::vector<float> values;  // row-major
};

// Bilinear value and the derivative of the same interpolant. Outside the image: that of the nearest
// border point, without slope across it.
struct Sample {
  double value, by_x, by_y;
};
Sample sample(const ScalarImage& image, double x_px, double y_px);

}  // namespace edgescout
