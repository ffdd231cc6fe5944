#include "host/core/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace edgescout {
namespace {

constexpr double PI = std::numbers::pi;

// Corners of a bar of 40 x 20 x 10 mm about the origin: mapped onto itself by half turns about x, y
// and z.
Object bar() {
  Object object;
  for (int corner = 0; corner < 8; ++corner)
    object.mesh.vertices_m.emplace_back(corner & 1 ? 0.02 : -0.02, corner & 2 ? 0.01 : -0.01,
                                        corner & 4 ? 0.005 : -0.005);
  object.mesh.diameter_m = std::sqrt(0.04 * 0.04 + 0.02 * 0.02 + 0.01 * 0.01);
  return object;
}

Se3 turn_z(double angle_rad) { return {so3_exp({0, 0, angle_rad}), {0, 0, 0}}; }

Camera pinhole() {
  Camera c;
  c.width = 640;
  c.height = 480;
  c.fx = c.fy = 500;
  c.cx = 319.5;
  c.cy = 239.5;
  return c;
}

TEST(Mssd, OfAShiftIsItsLength) {
  const Se3 truth{so3_exp({0.3, -0.2, 0.9}), {0.1, 0.2, 0.7}};
  Se3 estimate = truth;
  estimate.translation_m += Eigen::Vector3d(0.003, 0, -0.004);
  EXPECT_NEAR(mssd_m(estimate, truth, bar()), 0.005, 1e-12);
}

TEST(Mssd, OfATurnIsTheChordOfTheFarthestVertex) {
  const double angle = 0.2, radius = std::hypot(0.02, 0.01);
  EXPECT_NEAR(mssd_m(turn_z(angle), Se3{}, bar()), 2 * radius * std::sin(angle / 2), 1e-12);
}

TEST(Mssd, TakesTheBestSymmetry) {
  Object object = bar();
  EXPECT_NEAR(mssd_m(turn_z(PI), Se3{}, object), 2 * std::hypot(0.02, 0.01), 1e-12);
  object.symmetries.discrete.push_back(turn_z(PI));
  EXPECT_NEAR(mssd_m(turn_z(PI), Se3{}, object), 0, 1e-12);
  // The symmetry belongs to the object's side of the pose, whatever the pose.
  const Se3 truth{so3_exp({1.0, -0.4, 0.2}), {0.05, -0.02, 0.6}};
  EXPECT_NEAR(mssd_m(truth * turn_z(PI + 0.1), truth, object),
              2 * std::hypot(0.02, 0.01) * std::sin(0.05), 1e-12);
}

TEST(Mspd, OfASidewaysShiftIsItsProjectionAtTheNearestVertex) {
  const Se3 truth{Eigen::Quaterniond::Identity(), {0, 0, 0.505}};
  Se3 estimate = truth;
  estimate.translation_m.x() += 0.002;
  EXPECT_NEAR(mspd_px(estimate, truth, bar(), pinhole()), 500 * 0.002 / 0.5, 1e-9);
}

TEST(Mspd, OfADepthErrorIsSeenAtTheRimOnly) {
  const Se3 truth{Eigen::Quaterniond::Identity(), {0, 0, 0.505}},
      estimate{Eigen::Quaterniond::Identity(), {0, 0, 0.525}};
  const double rim = std::hypot(0.02, 0.01);
  EXPECT_NEAR(mspd_px(estimate, truth, bar(), pinhole()), 500 * rim * (1 / 0.5 - 1 / 0.52), 1e-9);
}

TEST(Mspd, IsInfiniteBehindTheCamera) {
  const Se3 truth{Eigen::Quaterniond::Identity(), {0, 0, 0.5}},
      behind{Eigen::Quaterniond::Identity(), {0, 0, -0.5}};
  EXPECT_TRUE(std::isinf(mspd_px(behind, truth, bar(), pinhole())));
}

TEST(PoseError, IsRawWithoutSymmetries) {
  const Se3 truth{so3_exp({0.1, 0.2, 0.3}), {0, 0, 0.5}};
  Se3 estimate = truth * turn_z(0.07);
  estimate.translation_m.y() += 0.004;
  const PoseError error = pose_error(estimate, truth, Symmetries{});
  EXPECT_NEAR(error.angle_rad, 0.07, 1e-12);
  EXPECT_NEAR(error.distance_m, 0.004, 1e-12);
  EXPECT_TRUE(error.passes());
  EXPECT_FALSE(error.passes(0.05));
  EXPECT_FALSE(error.passes(0.1, 0.004 - 1e-9));
  EXPECT_NEAR(error.of_bounds(), 0.8, 1e-9) << "of the distance's";
  EXPECT_NEAR(error.of_bounds(0.05), 1.4, 1e-9) << "of the angle's";
}

// A symmetry with a shift: the one with the smaller angle is not the one that passes.
TEST(PoseError, TakesTheSymmetryThatPassesMostEasily) {
  Symmetries symmetries;
  symmetries.discrete.push_back({so3_exp({0, 0, 0.09}), {0.004, 0, 0}});
  const Se3 estimate{Eigen::Quaterniond::Identity(),
                     {0.0045, 0, 0}};  // raw: 0 rad, 4.5 mm (0.9); other: 0.09 rad, 0.5 mm (0.9)
  Se3 nearer = estimate;
  nearer.translation_m.x() = 0.00451;
  EXPECT_NEAR(pose_error(nearer, Se3{}, symmetries).angle_rad, 0.09, 1e-12);
  nearer.translation_m.x() = 0.00449;
  EXPECT_NEAR(pose_error(nearer, Se3{}, symmetries).angle_rad, 0, 1e-12);
}

// Five millimetres off at every symmetry: which one counts is up to the angle, and to the bounds.
TEST(PoseError, TakesTheSmallestAngleOfSymmetriesAlike) {
  Symmetries turns;
  for (int i = 1; i < 8; ++i) turns.discrete.push_back({so3_exp({0, 0, 0.01 * i}), {0, 0, 0}});
  Se3 estimate{so3_exp({0, 0, 0.052}), {0.0045, 0, 0}};
  EXPECT_NEAR(pose_error(estimate, Se3{}, turns).angle_rad, 0.002, 1e-12);
  EXPECT_TRUE(pose_error(estimate, Se3{}, turns, 0.003, 0.02).passes(0.003, 0.02));
  Symmetries shifted;
  shifted.discrete.push_back({so3_exp({0, 0, 0.06}), {0.004, 0, 0}});
  estimate = {Eigen::Quaterniond::Identity(), {0.0045, 0, 0}};
  EXPECT_NEAR(pose_error(estimate, Se3{}, shifted).angle_rad, 0.06, 1e-12);
  EXPECT_NEAR(pose_error(estimate, Se3{}, shifted, 0.03, 0.01).angle_rad, 0, 1e-12);
}

}  // namespace
}  // namespace edgescout
