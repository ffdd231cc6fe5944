// Rigid transforms and their tangent space.
//
// A transform named `b_from_a` maps a point in frame a to frame b: x_in_b = b_from_a * x_in_a.
// The tangent is [translation m, rotation rad]. Both parts act on the left, independently:
//
//   retract(T, d):  translation' = translation + d.head<3>()
//                   rotation' = exp(d.tail<3>()) * rotation
//
// So the rotation turns the object about its own origin, along axes of the destination frame. The
// project uses this convention everywhere, also for covariances.
//
// Public header.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

namespace edgescout {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct Se3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit norm
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
};

Se3 operator*(const Se3& c_from_b, const Se3& b_from_a);
Eigen::Vector3d operator*(const Se3& b_from_a, const Eigen::Vector3d& x_in_a);
Se3 inverse(const Se3& b_from_a);

// Returns the pose of a rotation matrix, which it orthonormalises, and a translation. InputError
// where it is not orthonormal with determinant +1 to 1e-3.
Se3 se3_from_matrix(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation_m);

Eigen::Quaterniond so3_exp(const Eigen::Vector3d& rotation_rad);
Eigen::Vector3d so3_log(const Eigen::Quaterniond& rotation);  // angle in [0, pi]

Se3 retract(const Se3& b_from_a, const Vector6d& delta);
// Moves a pose as retract does, but turns about `center_m` (object frame), which moves by
// delta.head<3>(). Use it for objects whose origin may lie far from their middle.
Se3 retract_about(const Se3& b_from_a, const Eigen::Vector3d& center_m, const Vector6d& delta);
// Returns the covariance of a delta of retract_about, from that of a delta of retract.
Matrix6d covariance_about(const Se3& b_from_a, const Eigen::Vector3d& center_m,
                          const Matrix6d& covariance);
// Returns the d with retract(from, d) == to.
Vector6d local_coordinates(const Se3& from, const Se3& to);

bool is_finite(const Se3& transform);
// Checks a pose. InputError naming `source` and `field`: a value that is not finite, a quaternion
// whose length is not 1 to 1e-3.
void require_rigid(const Se3& transform, const std::string& source, const std::string& field);

double angle_between_rad(const Se3& a, const Se3& b);
double distance_between_m(const Se3& a, const Se3& b);

}  // namespace edgescout
