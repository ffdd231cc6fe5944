// The pose space of core/se3.h for Ceres: 7 parameters [tx ty tz, qx qy qz qw], tangent
// [translation m, rotation rad].
//
// Ceres' own quaternion manifolds use half the angle and another order. Covariances of both solvers
// must agree. Private to host/register and its tests: only this header and point_cost.h include
// Ceres.
#pragma once

#include <array>

#include <ceres/manifold.h>

#include "host/core/se3.h"

namespace edgescout {

using PoseParameters = std::array<double, 7>;
PoseParameters to_parameters(const Se3& pose);
// Does not normalise the quaternion: Se3Manifold::Plus keeps its norm at 1.
Se3 from_parameters(const double* parameters);

// Plus(x, d) = retract(x, d), Minus(y, x) = local_coordinates(x, y).
class Se3Manifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace edgescout
