#include "host/detect/same_pose.h"

#include <gtest/gtest.h>

#include <numbers>

#include "host/render/parts.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

const Camera camera{640, 480, 500, 500, 319.5, 239.5, {}};
const Se3 given{so3_exp({0.3, 0.2, 0.1}), {0, 0, 0.5}};

Se3 moved(double angle_rad, const Eigen::Vector3d& distance_m) {
  Vector6d off;
  off << distance_m, angle_rad, 0, 0;
  return retract(given, off);
}

TEST(SamePose, IsWithinBothBounds) {
  const SamePose is_same(make_part("l_bracket"), camera, given, {});
  EXPECT_TRUE(is_same(given));
  EXPECT_TRUE(is_same(moved(0.09, {0.004, 0, 0})));
  EXPECT_FALSE(is_same(moved(0.11, {0, 0, 0})));
  EXPECT_FALSE(is_same(moved(0, {0, 0, 0.006})));
  EXPECT_NEAR(is_same.of_bounds(moved(0.05, {0, 0.001, 0})), 0.5, 1e-9);
  EXPECT_NEAR(is_same.of_bounds(moved(0.01, {0, 0.004, 0})), 0.8, 1e-9);
}

TEST(SamePose, MayLookTheSameThoughTheDistanceIsOff) {
  SamePoseOptions options;
  options.max_mspd_px = 10;
  const SamePose is_same(make_part("l_bracket"), camera, given, options);
  EXPECT_TRUE(is_same(moved(0, {0, 0, 0.02}))) << "along the line of sight";
  EXPECT_FALSE(is_same(moved(0, {0.012, 0, 0}))) << "12 px aside";
  const double px = is_same.mspd_px(moved(0, {0.005, 0, 0}));
  EXPECT_NEAR(is_same.of_bounds(moved(0, {0.005, 0, 0})), px / 10, 1e-12);
}

TEST(SamePose, CountsModuloSymmetry) {
  Object part = make_part("l_bracket");
  part.symmetries.discrete = {Se3{}, {so3_exp({0, 0, std::numbers::pi}), {0.01, 0, 0}}};
  const Se3 equal = given * part.symmetries.discrete[1];
  EXPECT_TRUE(SamePose(part, camera, given, {})(equal));
  EXPECT_LT(SamePose(part, camera, given, {}).mspd_px(equal), 1e-6);
  part.symmetries = {};
  EXPECT_FALSE(SamePose(part, camera, given, {})(equal));
}

TEST(SamePose, RefusesBoundsThatNothingMeets) {
  SamePoseOptions options;
  options.max_angle_rad = 0;
  expect_input_error([&] { options.validate(); }, {"same_pose.max_angle"});
  options = {};
  options.max_mspd_px = -1;
  expect_input_error([&] { options.validate(); }, {"same_pose.max_mspd"});
}

}  // namespace
}  // namespace edgescout::test
