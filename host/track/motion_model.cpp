#include "host/track/motion_model.h"

#include <algorithm>
#include <limits>

#include "host/core/matrix6.h"

namespace edgescout {

namespace {

// The d with retract_about(from, center, d) == to.
Vector6d motion_about(const Se3& from, const Eigen::Vector3d& center_m, const Se3& to) {
  Vector6d motion;
  motion.head<3>() = to * center_m - from * center_m;
  motion.tail<3>() = so3_log(to.rotation * from.rotation.conjugate());
  return motion;
}

}  // namespace

Se3 MotionModel::predicted(double time_s) const {
  return time_s_ ? retract_about(pose_, center_m_, velocity_ * (time_s - *time_s_)) : pose_;
}

Matrix6d MotionModel::covariance() const {
  if (!time_s_) return Matrix6d::Constant(std::numeric_limits<double>::infinity());
  return covariance_about(pose_, -center_m_, covariance_);
}

// Hands and arms start, stop and turn: the motion is known to a part of itself, and to a thousandth
// of the distance where there is none.
Matrix6d MotionModel::predicted_covariance(double seconds) const {
  constexpr double part = 0.25, of_distance = 0.001, turn_rad = 0.005;
  const double sigma_m = part * velocity_.head<3>().norm() * seconds +
                         of_distance * (pose_ * center_m_).norm(),
               sigma_rad = part * velocity_.tail<3>().norm() * seconds + turn_rad;
  Matrix6d covariance = covariance_;
  covariance.diagonal().head<3>().array() += sigma_m * sigma_m;
  covariance.diagonal().tail<3>().array() += sigma_rad * sigma_rad;
  return covariance;
}

void MotionModel::set_velocity(const Se3& from, double seconds) {
  const Vector6d velocity = motion_about(from, center_m_, pose_) / seconds;
  velocity_ = has_velocity_ ? Vector6d(0.5 * (velocity_ + velocity)) : velocity;
  has_velocity_ = true;
}

void MotionModel::measured(const Se3& camera_from_object, const Matrix6d& covariance,
                           double time_s) {
  const Matrix6d measured = covariance_about(camera_from_object, center_m_, covariance);
  if (!time_s_) {
    pose_ = camera_from_object;
    covariance_ = measured;
    time_s_ = time_s;
    return;
  }
  const Se3 before = pose_, prediction = predicted(time_s);
  const double seconds = time_s - *time_s_;
  Matrix6d prior = predicted_covariance(seconds);
  const Vector6d off = motion_about(prediction, center_m_, camera_from_object);
  // A motion that surprises both: the object started or stopped, and the prediction counts less.
  const double surprise = off.dot(solve(prior + measured, off)) / 6;
  prior *= std::max(1.0, surprise);
  const Matrix6d gain = solve(prior + measured, prior).transpose();
  pose_ = retract_about(prediction, center_m_, gain * off);
  covariance_ = prior - gain * prior;
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  time_s_ = time_s;
  set_velocity(before, seconds);
}

void MotionModel::coast(double time_s) {
  constexpr double kept = 0.7;  // of the velocity, in each frame
  if (!time_s_) return;
  pose_ = predicted(time_s);
  covariance_ = predicted_covariance(time_s - *time_s_);
  velocity_ *= kept;
  time_s_ = time_s;
}

}  // namespace edgescout
