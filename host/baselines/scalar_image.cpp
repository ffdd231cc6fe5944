#include "host/baselines/scalar_image.h"

#include <algorithm>

namespace edgescout {

Sample sample(const ScalarImage& image, double x_px, double y_px) {
  const double x = std::clamp(x_px, 0.0, double(image.width - 1)),
               y = std::clamp(y_px, 0.0, double(image.height - 1));
  const int x0 = std::min(int(x), std::max(0, image.width - 2)),
            y0 = std::min(int(y), std::max(0, image.height - 2));
  const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  const auto at = [&](int column, int row) {
    return double(image.values[std::size_t(row) * image.width + column]);
  };
  const double ax = x - x0, ay = y - y0, v00 = at(x0, y0), v10 = at(x1, y0), v01 = at(x0, y1),
               v11 = at(x1, y1);
  return {(1 - ay) * ((1 - ax) * v00 + ax * v10) + ay * ((1 - ax) * v01 + ax * v11),
          x == x_px ? (1 - ay) * (v10 - v00) + ay * (v11 - v01) : 0,
          y == y_px ? (1 - ax) * (v01 - v00) + ax * (v11 - v10) : 0};
}

}  // namespace edgescout
