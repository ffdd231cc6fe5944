#include "host/track/motion_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace edgescout {
namespace {

const Eigen::Vector3d far_center(0.2, 0, 0.1);  // of an object whose origin lies outside

Matrix6d sure() { return 1e-10 * Matrix6d::Identity(); }

// Turns about its centre while the centre moves along a line.
Se3 moving_pose(double time_s) {
  const Se3 first{Eigen::Quaterniond::Identity(), {0, 0, 0.5}};
  Vector6d motion;
  motion << 0.1 * time_s, -0.05 * time_s, 0.02 * time_s, 0, 0.3 * time_s, 0;
  return retract_about(first, far_center, motion);
}

TEST(MotionModel, PredictsConstantVelocityAndTurnRateAboutTheCenter) {
  MotionModel motion(far_center, moving_pose(0));
  for (const double time_s : {10.0, 10.1, 10.25})
    motion.measured(moving_pose(time_s), sure(), time_s);
  const Se3 predicted = motion.predicted(10.6), truth = moving_pose(10.6);
  EXPECT_LT(distance_between_m(predicted, truth), 1e-5);
  EXPECT_LT(angle_between_rad(predicted, truth), 1e-4);
}

// The pose that a user gives is only roughly right: what corrects it is no motion.
TEST(MotionModel, TakesNoVelocityFromTheFirstMeasurement) {
  MotionModel motion(far_center, moving_pose(0));
  motion.measured(moving_pose(1), sure(), 5);
  EXPECT_LT(distance_between_m(motion.predicted(6), moving_pose(1)), 1e-12);
}

TEST(MotionModel, SlowsDownWithoutMeasurements) {
  MotionModel motion(Eigen::Vector3d::Zero(), {});
  motion.measured({Eigen::Quaterniond::Identity(), {0, 0, 1}}, sure(), 0);
  motion.measured({Eigen::Quaterniond::Identity(), {0.1, 0, 1}}, sure(), 1);
  for (int second = 2; second < 30; ++second) motion.coast(second);
  EXPECT_GT(motion.pose().translation_m.x(), 0.2);
  EXPECT_LT(motion.pose().translation_m.x(), 0.5);
  EXPECT_LT(motion.velocity().norm(), 1e-4);
}

// The place along the line of sight is measured badly, the others well.
TEST(MotionModel, ThePredictionCountsWhereTheMeasurementDoesNot) {
  MotionModel motion(Eigen::Vector3d::Zero(), {});
  motion.measured({Eigen::Quaterniond::Identity(), {0, 0, 1}}, sure(), 0);
  Matrix6d covariance = sure();
  covariance(2, 2) = 0.1 * 0.1;
  motion.measured({Eigen::Quaterniond::Identity(), {0.002, 0, 1.08}}, covariance, 1);
  EXPECT_NEAR(motion.pose().translation_m.x(), 0.002, 1e-4);
  EXPECT_NEAR(motion.pose().translation_m.z(), 1, 1e-3);
  EXPECT_LT(std::sqrt(motion.covariance()(2, 2)), 0.002);
}

TEST(MotionModel, FollowsASuddenMotionAtOnce) {
  MotionModel motion(Eigen::Vector3d::Zero(), {});
  Matrix6d covariance = 0.0005 * 0.0005 * Matrix6d::Identity();
  for (const double time_s : {0.0, 1.0, 2.0})
    motion.measured({Eigen::Quaterniond::Identity(), {0, 0, 0.5}}, covariance, time_s);
  motion.measured({Eigen::Quaterniond::Identity(), {0.02, 0, 0.5}}, covariance, 3);
  EXPECT_NEAR(motion.pose().translation_m.x(), 0.02, 0.0005);
}

TEST(MotionModel, IsLessAndLessSureWithoutMeasurements) {
  MotionModel motion(far_center, moving_pose(0));
  EXPECT_TRUE(std::isinf(motion.covariance()(0, 0)));
  motion.coast(1);
  EXPECT_TRUE(std::isinf(motion.covariance()(0, 0)));
  motion.measured(moving_pose(2), sure(), 2);
  double last = motion.covariance()(0, 0);
  for (int second = 3; second < 8; ++second) {
    motion.coast(second);
    EXPECT_GT(motion.covariance()(0, 0), last);
    last = motion.covariance()(0, 0);
  }
}

}  // namespace
}  // namespace edgescout
