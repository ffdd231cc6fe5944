#include "host/core/se3.h"

#include <cmath>

#include "kernels/error.h"

namespace edgescout {

Se3 operator*(const Se3& c_from_b, const Se3& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b.rotation * b_from_a.translation_m + c_from_b.translation_m};
}

Eigen::Vector3d operator*(const Se3& b_from_a, const Eigen::Vector3d& x_in_a) {
  return b_from_a.rotation * x_in_a + b_from_a.translation_m;
}

bool is_finite(const Se3& transform) {
  return transform.translation_m.allFinite() && transform.rotation.coeffs().allFinite();
}

void require_rigid(const Se3& transform, const std::string& source, const std::string& field) {
  if (!is_finite(transform))
    throw InputError(source, field, "a value that is not finite", "a rigid transform");
  const double length = transform.rotation.norm();
  if (std::abs(length - 1) > 1e-3)
    throw InputError(source, field, "a quaternion of length " + std::to_string(length),
                     "a rigid transform");
}

Se3 inverse(const Se3& b_from_a) {
  const Eigen::Quaterniond back = b_from_a.rotation.conjugate();
  return {back, -(back * b_from_a.translation_m)};
}

Se3 se3_from_matrix(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation_m) {
  const double defect =
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!rotation.allFinite() || !translation_m.allFinite())
    throw InputError("pose: found a value that is not finite, expected a rigid transform");
  if (defect > 1e-3 || rotation.determinant() < 0)
    throw InputError(
        "pose: found a 3x3 matrix that is no rotation, expected R'R = I and det R = +1");
  return {Eigen::Quaterniond(rotation).normalized(), translation_m};
}

Eigen::Quaterniond so3_exp(const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  // sin(a/2)/a. Near zero by its series: the quotient would lose precision there.
  const double scale = angle < 1e-6 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  const Eigen::Vector3d v = scale * rotation_rad;
  return Eigen::Quaterniond(std::cos(0.5 * angle), v.x(), v.y(), v.z()).normalized();
}

Eigen::Vector3d so3_log(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0 ? -1.0 : 1.0;
  const double sine = rotation.vec().norm();
  const double angle = 2.0 * std::atan2(sine, sign * rotation.w());
  const double scale = sine < 1e-9 ? 2.0 : angle / sine;
  return sign * scale * rotation.vec();
}

Se3 retract(const Se3& b_from_a, const Vector6d& delta) {
  return {(so3_exp(delta.tail<3>()) * b_from_a.rotation).normalized(),
          b_from_a.translation_m + delta.head<3>()};
}

Se3 retract_about(const Se3& b_from_a, const Eigen::Vector3d& center_m, const Vector6d& delta) {
  Se3 moved = retract(b_from_a, delta);
  moved.translation_m += b_from_a.rotation * center_m - moved.rotation * center_m;
  return moved;
}

Matrix6d covariance_about(const Se3& b_from_a, const Eigen::Vector3d& center_m,
                          const Matrix6d& covariance) {
  const Eigen::Vector3d lever_m = b_from_a.rotation * center_m;
  Matrix6d about = Matrix6d::Identity();  // the centre moves by the translation plus turn x arm
  about.topRightCorner<3, 3>() << 0, lever_m.z(), -lever_m.y(), -lever_m.z(), 0, lever_m.x(),
      lever_m.y(), -lever_m.x(), 0;
  return about * covariance * about.transpose();
}

Vector6d local_coordinates(const Se3& from, const Se3& to) {
  Vector6d delta;
  delta << to.translation_m - from.translation_m, so3_log(to.rotation * from.rotation.conjugate());
  return delta;
}

double angle_between_rad(const Se3& a, const Se3& b) {
  return so3_log(a.rotation * b.rotation.conjugate()).norm();
}

double distance_between_m(const Se3& a, const Se3& b) {
  return (a.translation_m - b.translation_m).norm();
}

}  // namespace edgescout
