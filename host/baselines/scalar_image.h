// An image of real numbers with bilinear interpolation.
#pragma once

#include <vector>

namespace edgescout {

struct ScalarImage {
  int width = 0;
  int height = 0;
  std::vector<float> values;  // row-major
};

// Bilinear value and the derivative of the same interpolant. Outside the image: those of the
// nearest border point, with slope 0 across the border.
struct Sample {
  double value, by_x, by_y;
};
Sample sample(const ScalarImage& image, double x_px, double y_px);

}  // namespace edgescout
