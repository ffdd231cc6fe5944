// The laws of rigid transforms and of their tangent.
#include "host/core/se3.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "kernels/error.h"
#include "tests/io/expect_input_error.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

constexpr double pi = std::numbers::pi;

Se3 random_pose(Random& random) {
  return {random.rotation(), 2 * random.uniform() * random.direction()};
}

Eigen::Matrix4d homogeneous(const Se3& pose) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = pose.translation_m;
  return m;
}

TEST(Se3, MultipliesAndInvertsLikeMatrices) {
  Random random = test::test_random();
  for (int i = 0; i < 100; ++i) {
    const Se3 a = random_pose(random), b = random_pose(random);
    const Eigen::Vector3d x = random.direction();
    EXPECT_NEAR((homogeneous(a * b) - homogeneous(a) * homogeneous(b)).norm(), 0, 1e-12);
    EXPECT_NEAR((homogeneous(inverse(a)) - homogeneous(a).inverse()).norm(), 0, 1e-12);
    EXPECT_NEAR((a * x - (homogeneous(a) * x.homogeneous()).head<3>()).norm(), 0, 1e-12);
  }
}

TEST(Se3, RotationsOfManyProductsStayUnit) {
  Random random = test::test_random();
  Se3 product;
  for (int i = 0; i < 10000; ++i)
    product = product * Se3{random.rotation(), Eigen::Vector3d::Zero()};
  EXPECT_NEAR(product.rotation.norm(), 1, 1e-14);
}

TEST(Se3, ExponentialIsTheRotationByThatAngle) {
  Random random = test::test_random();
  for (const double angle :
       {0.0, 1e-15, 1e-9, 0.999e-6, 1.001e-6, 1e-3, 1.0, pi - 1e-9, pi, 4.0, 2 * pi}) {
    const Eigen::Vector3d axis = random.direction();
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_NEAR((so3_exp(angle * axis).toRotationMatrix() - expected).norm(), 0, 1e-14) << angle;
  }
}

TEST(Se3, LogarithmUndoesTheExponential) {
  Random random = test::test_random();
  for (const double angle :
       {0.0, 1e-15, 1e-12, 1e-9, 2.1e-9, 1e-6, 1e-3, 1.0, 3.0, pi - 1e-3, pi - 1e-7, pi - 1e-12})
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d w = angle * random.direction();
      const Eigen::Quaterniond q = so3_exp(w);
      const double tolerance = 1e-14 + 1e-12 * angle;
      EXPECT_NEAR((so3_log(q) - w).norm(), 0, tolerance) << angle;
      // The other quaternion of the same rotation.
      EXPECT_NEAR((so3_log(Eigen::Quaterniond(-q.coeffs())) - w).norm(), 0, tolerance) << angle;
    }
}

TEST(Se3, LogarithmTakesTheShorterWay) {
  Random random = test::test_random();
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d axis = random.direction();
    const double angle = random.uniform(pi, 2 * pi);
    EXPECT_NEAR((so3_log(so3_exp(angle * axis)) - (angle - 2 * pi) * axis).norm(), 0, 1e-9);
  }
  // At half a turn both ways are right; the axis must be.
  const Eigen::Vector3d half_turn = so3_log(Eigen::Quaterniond(0, 0, 1, 0));
  EXPECT_NEAR(half_turn.norm(), pi, 1e-14);
  EXPECT_NEAR(std::abs(half_turn.y()), pi, 1e-14);
}

TEST(Se3, RetractAndLocalCoordinatesUndoEachOther) {
  Random random = test::test_random();
  for (int i = 0; i < 200; ++i) {
    const Se3 from = random_pose(random), to = random_pose(random);
    Vector6d delta;
    delta << random.direction() * random.uniform(), random.direction() * random.uniform(0, 3.1);
    EXPECT_NEAR((local_coordinates(from, retract(from, delta)) - delta).norm(), 0, 1e-9);
    EXPECT_NEAR((homogeneous(retract(from, local_coordinates(from, to))) - homogeneous(to)).norm(),
                0, 1e-9);
  }
}

TEST(Se3, TangentActsOnTheLeftAndAboutTheObjectsOrigin) {
  Se3 pose{so3_exp({0.3, -0.2, 0.9}), {0.1, 0.2, 0.7}};
  Vector6d turn = Vector6d::Zero();
  turn[5] = 0.5;
  const Se3 turned = retract(pose, turn);
  EXPECT_EQ(turned.translation_m, pose.translation_m);
  // Along axes of the destination frame: a point off the origin turns about the destination's z.
  const Eigen::Vector3d arm = pose * Eigen::Vector3d(1, 2, 3) - pose.translation_m;
  const Eigen::Vector3d expected = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()) * arm;
  EXPECT_NEAR((turned * Eigen::Vector3d(1, 2, 3) - pose.translation_m - expected).norm(), 0, 1e-12);
}

TEST(Se3, DistancesMeasureWhatWasMoved) {
  const Se3 a{so3_exp({0.1, 0.2, 0.3}), {1, 2, 3}};
  Vector6d delta;
  delta << 0.3, 0, 0.4, 0, -0.7, 0;
  const Se3 b = retract(a, delta);
  EXPECT_NEAR(distance_between_m(a, b), 0.5, 1e-12);
  EXPECT_NEAR(angle_between_rad(a, b), 0.7, 1e-12);
  EXPECT_NEAR(angle_between_rad(b, a), 0.7, 1e-12);
}

TEST(Se3, MatricesAreCheckedAndMadeOrthonormal) {
  Random random = test::test_random();
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d exact = random.rotation().toRotationMatrix();
    const Se3 pose = se3_from_matrix(exact + 1e-4 * Eigen::Matrix3d::Random(), {1, 2, 3});
    EXPECT_NEAR(pose.rotation.norm(), 1, 1e-12);
    EXPECT_LT((pose.rotation.toRotationMatrix() - exact).norm(), 1e-3);
    EXPECT_EQ(pose.translation_m, Eigen::Vector3d(1, 2, 3));
  }
}

TEST(Se3, RefusesMatricesThatAreNoRotations) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  EXPECT_THROW(se3_from_matrix(-identity, zero), InputError);
  EXPECT_THROW(se3_from_matrix(1.01 * identity, zero), InputError);
  Eigen::Matrix3d sheared = identity;
  sheared(0, 1) = 0.01;
  EXPECT_THROW(se3_from_matrix(sheared, zero), InputError);
  Eigen::Matrix3d broken = identity;
  broken(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(se3_from_matrix(broken, zero), InputError);
  EXPECT_THROW(se3_from_matrix(identity, {0, std::numeric_limits<double>::infinity(), 0}),
               InputError);
}

TEST(Se3, WhatIsNotRigidIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Se3 pose{Eigen::Quaterniond(1, 0, 0, 0), {1, 2, 3}};
  require_rigid(pose, "views.json", "/3");
  pose.rotation.coeffs() *= 1.0009;
  require_rigid(pose, "views.json", "/3");
  pose.rotation.coeffs() *= 1.0009;
  test::expect_input_error([&] { require_rigid(pose, "views.json", "/3"); },
                           {"views.json", "/3", "length 1.0018", "rigid"});
  pose.rotation.coeffs() = Eigen::Vector4d(0, nan, 0, 1);
  test::expect_input_error([&] { require_rigid(pose, "views.json", "/3"); },
                           {"/3", "not finite", "rigid"});
  pose = {Eigen::Quaterniond::Identity(), {0, 0, std::numeric_limits<double>::infinity()}};
  test::expect_input_error([&] { require_rigid(pose, "views.json", "/3"); }, {"/3", "not finite"});
}

}  // namespace
}  // namespace edgescout
