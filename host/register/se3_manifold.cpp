#include "host/register/se3_manifold.h"

#include <algorithm>

namespace edgescout {

namespace {

// Derivative of exp(w) * q by w at zero, rows in the order x y z w: half the product of the pure
// quaternion w with q.
Eigen::Matrix<double, 4, 3> quaternion_by_rotation(const double* q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Eigen::Matrix<double, 4, 3> by_rotation;
  by_rotation << w, z, -y, -z, w, x, y, -x, w, -x, -y, -z;
  return 0.5 * by_rotation;
}

}  // namespace

PoseParameters to_parameters(const Se3& pose) {
  const Eigen::Vector3d& t = pose.translation_m;
  const Eigen::Quaterniond& q = pose.rotation;
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

Se3 from_parameters(const double* p) {
  return {Eigen::Quaterniond(p[6], p[3], p[4], p[5]), {p[0], p[1], p[2]}};
}

bool Se3Manifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const PoseParameters moved =
      to_parameters(retract(from_parameters(x), Eigen::Map<const Vector6d>(delta)));
  std::copy(moved.begin(), moved.end(), x_plus_delta);
  return true;
}

bool Se3Manifold::PlusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> by_tangent(jacobian);
  by_tangent.setZero();
  by_tangent.topLeftCorner<3, 3>().setIdentity();
  by_tangent.bottomRightCorner<4, 3>() = quaternion_by_rotation(x + 3);
  return true;
}

bool Se3Manifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Vector6d> difference(y_minus_x);
  difference = local_coordinates(from_parameters(x), from_parameters(y));
  return true;
}

bool Se3Manifold::MinusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> by_ambient(jacobian);
  by_ambient.setZero();
  by_ambient.topLeftCorner<3, 3>().setIdentity();
  // The columns of the Jacobian of Plus are orthogonal and of length 1/2. Four times its transpose
  // is its inverse on the tangent.
  by_ambient.bottomRightCorner<3, 4>() = 4 * quaternion_by_rotation(x + 3).transpose();
  return true;
}

}  // namespace edgescout
