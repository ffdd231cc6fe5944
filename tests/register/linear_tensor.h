// A tensor with an interpolant in closed form: linear in x, y and orientation. Costs can be
// differentiated in double without the code under test.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "host/core/random.h"
#include "host/core/se3.h"
#include "kernels/pose_normal_equations.h"

namespace edgescout::test {

// Where a model point lands: pixel, orientation in [0, pi), |d(projection) * tangent| over fx / z.
struct Landing {
  double u, v, theta, foreshortening, z;
};

// Projects two near points of the edge.
inline Landing land(const Intrinsics& k, const Se3& camera_from_object, const ModelPoint& m) {
  constexpr double apart = 1e-6;
  const Eigen::Vector3d x(m.x_m, m.y_m, m.z_m), t(m.tx, m.ty, m.tz);
  const auto pixel = [&](const Eigen::Vector3d& in_object) {
    const Eigen::Vector3d p = camera_from_object * in_object;
    return Eigen::Vector2d(k.fx * p.x() / p.z() + k.cx, k.fy * p.y() / p.z() + k.cy);
  };
  const double z = (camera_from_object * x).z();
  const Eigen::Vector2d at = pixel(x),
                        d = (pixel(x + apart * t) - pixel(x - apart * t)) / (2 * apart);
  double theta = std::atan2(d.y(), d.x());
  if (theta < 0) theta += std::numbers::pi;
  return {at.x(), at.y(), theta, d.norm() * z / k.fx, z};
}

struct LinearTensor {
  TensorShape shape{320, 240, 60};
  Intrinsics intrinsics{410, 430, 155.5f, 118.25f};
  int base, by_x, by_y, by_bin;  // in units
  std::vector<std::uint16_t> values;

  explicit LinearTensor(int by_x_ = 37, int by_y_ = -23, int by_bin_ = 211)
      : base(9000), by_x(by_x_), by_y(by_y_), by_bin(by_bin_), values(shape.size()) {
    for (int y = 0; y < shape.height; ++y)
      for (int x = 0; x < shape.width; ++x)
        for (int k = 0; k < shape.bins; ++k)
          values[shape.index(x, y, k)] =
              static_cast<std::uint16_t>(base + by_x * x + by_y * y + by_bin * k);
  }
  TensorView view() const { return {values, shape, intrinsics}; }
  // Residual in px where the point lands inside the image and off the seam of the orientations.
  double residual(const Landing& at) const {
    return (base + by_x * at.u + by_y * at.v + by_bin * shape.bins * at.theta / std::numbers::pi) /
           DCD_UNITS_PER_PX;
  }
  bool holds(const Landing& at) const {
    return at.u > 1 && at.v > 1 && at.u < shape.width - 2 && at.v < shape.height - 2 &&
           at.theta > 0.15 && at.theta < std::numbers::pi - 0.2 && at.foreshortening > 0.2;
  }
};

inline double rho(const PoseLoss& loss, double r) {
  const double s = loss.scale_px;
  if (loss.kind == LOSS_HUBER) return r <= s ? 0.5 * r * r : s * (r - 0.5 * s);
  return 0.5 * s * s * r * r / (s * s + r * r);
}

inline ModelPoint random_point(Random& random, double reach_m) {
  const Eigen::Vector3f x = (reach_m * random.uniform() * random.direction()).cast<float>(),
                        t = random.direction().cast<float>();
  return {x.x(), x.y(), x.z(), t.x(), t.y(), t.z()};
}

}  // namespace edgescout::test
