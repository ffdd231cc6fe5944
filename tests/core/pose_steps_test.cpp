#include "host/core/pose_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace edgescout {
namespace {

// Metres, then radians.
Vector6d step_of(double along_y_m, double about_z_rad) {
  Vector6d step = Vector6d::Zero();
  step[1] = along_y_m;
  step[5] = about_z_rad;
  return step;
}

TEST(PoseSteps, AreSmallWherePlaceAndDirectionAre) {
  EXPECT_TRUE(is_small(step_of(-0.9, 0.09), 1, 0.1));
  EXPECT_FALSE(is_small(step_of(-1.1, 0.09), 1, 0.1));
  EXPECT_FALSE(is_small(step_of(-0.9, 0.11), 1, 0.1));
}

// Two points of one weight, which one metre along y moves by 300 and 400 px.
TEST(PoseSteps, MoveThePointsByTheRootMeanSquare) {
  Matrix6d hessian = Matrix6d::Zero();
  hessian(1, 1) = 300 * 300 + 400 * 400;
  EXPECT_NEAR(rms_motion_px(step_of(-0.01, 0), hessian, 2), 0.01 * 500 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(rms_motion_px(step_of(-0.01, 0), hessian, 0), 0) << "no points";
}

TEST(PoseCovariance, IsTheScaledInverseAndUnknownWhereSomethingIsNotSeen) {
  Matrix6d hessian = 4 * Matrix6d::Identity();
  EXPECT_LT((pose_covariance(hessian, 3) - 0.75 * Matrix6d::Identity()).norm(), 1e-15);
  hessian(0, 0) = 0;
  const Matrix6d unknown = pose_covariance(hessian, 3);
  EXPECT_TRUE((unknown.diagonal().array() == std::numeric_limits<double>::infinity()).all());
  EXPECT_EQ(unknown(0, 1), 0) << "not a number, as zero times infinity is";
}

}  // namespace
}  // namespace edgescout
