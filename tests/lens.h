// What a lens does to pixels, apart from OpenCV.
#pragma once

#include <Eigen/Core>

#include "host/core/camera.h"

namespace edgescout::test {

// Brown-Conrady forward model, written out.
inline Eigen::Vector2d distort(const Camera& c, double u, double v) {
  const double x = (u - c.cx) / c.fx, y = (v - c.cy) / c.fy, r2 = x * x + y * y;
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tau_x, tau_y] = c.distortion;
  const double radial =
      (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  return {c.fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + c.cx,
          c.fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + c.cy};
}

inline Eigen::Vector2d undistort_point(const Camera& camera, const Eigen::Vector2d& seen) {
  Eigen::Vector2d ideal = seen;
  for (int i = 0; i < 100; ++i) ideal += seen - distort(camera, ideal.x(), ideal.y());
  return ideal;
}

}  // namespace edgescout::test
