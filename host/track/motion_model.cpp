#include "host/track/motion_model.h"

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

void MotionModel::measured(const Se3& camera_from_object, double time_s) {
  if (time_s_ && time_s > *time_s_) {
    const Vector6d velocity =
        motion_about(pose_, center_m_, camera_from_object) / (time_s - *time_s_);
    velocity_ = has_velocity_ ? Vector6d(0.5 * (velocity_ + velocity)) : velocity;
    has_velocity_ = true;
  }
  pose_ = camera_from_object;
  time_s_ = time_s;
}

void MotionModel::coast(double time_s) {
  constexpr double kept = 0.7;  // of the velocity, in each frame: hands and arms stop
  pose_ = predicted(time_s);
  velocity_ *= kept;
  time_s_ = time_s;
}

}  // namespace edgescout
