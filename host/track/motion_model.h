// Predicts the next pose of an object from its last ones: constant velocity of its centre and
// constant turn rate.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "host/core/se3.h"

namespace edgescout {

class MotionModel {
 public:
  // `center_m`: the object's, in its own frame. An object whose origin lies far from its middle is
  // not mistaken for one that moves when it turns.
  MotionModel(const Eigen::Vector3d& center_m, const Se3& camera_from_object)
      : center_m_(center_m), pose_(camera_from_object) {}

  Se3 predicted(double time_s) const;
  // A measured pose: the velocity becomes the mean of the predicted and the measured one.
  void measured(const Se3& camera_from_object, double time_s);
  // No measurement: the object goes on along the prediction, slower.
  void coast(double time_s);

  const Se3& pose() const { return pose_; }
  const Vector6d& velocity() const { return velocity_; }  // of retract_about: m/s, rad/s

 private:
  Eigen::Vector3d center_m_;
  Se3 pose_;
  Vector6d velocity_ = Vector6d::Zero();
  bool has_velocity_ = false;
  std::optional<double> time_s_;  // of the last measurement or coast; none yet: at rest
};

}  // namespace edgescout
