// Predicts the next pose of an object from its last ones, and joins prediction and measurement: a
// Kalman filter of the pose whose velocity is that of the last poses.
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

  // At constant velocity of the centre and constant turn rate.
  Se3 predicted(double time_s) const;
  // A measured pose with its covariance (tangent of core/se3.h), finite. In directions that it
  // determines badly the prediction counts. The first measurement is taken as it is.
  void measured(const Se3& camera_from_object, const Matrix6d& covariance, double time_s);
  // No measurement: the object goes on along the prediction, slower.
  void coast(double time_s);

  const Se3& pose() const { return pose_; }
  // Of the pose, in the tangent of core/se3.h; infinite before the first measurement.
  Matrix6d covariance() const;
  const Vector6d& velocity() const { return velocity_; }  // of retract_about: m/s, rad/s

 private:
  Matrix6d predicted_covariance(double seconds) const;
  void set_velocity(const Se3& from, double seconds);

  Eigen::Vector3d center_m_;
  Se3 pose_;
  Matrix6d covariance_ = Matrix6d::Zero();  // of a delta of retract_about
  Vector6d velocity_ = Vector6d::Zero();
  bool has_velocity_ = false;
  std::optional<double> time_s_;  // of the last measurement or coast; none yet: at rest
};

}  // namespace edgescout
