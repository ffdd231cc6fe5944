#include "host/core/camera_check.h"

#include <gtest/gtest.h>

#include <numbers>

namespace edgescout {
namespace {

Camera plausible() { return {640, 480, 700, 702, 322, 236, {-0.25, 0.12, 0.001, -0.0005}}; }

void expect_warning(const Camera& camera, const std::string& field) {
  const std::vector<std::string> warnings = implausible_in(camera);
  ASSERT_EQ(warnings.size(), 1u) << field;
  EXPECT_EQ(warnings[0].rfind(field + ": found ", 0), 0u) << warnings[0];
  EXPECT_NE(warnings[0].find(", expected "), std::string::npos) << warnings[0];
}

TEST(CameraCheck, AcceptsACommonCamera) {
  EXPECT_TRUE(implausible_in(plausible()).empty());
  Camera fisheye{1280, 960, 380, 380, 640, 480, {-0.03, 0.01, -0.005, 0.001}};
  fisheye.lens = LensModel::Fisheye;
  EXPECT_TRUE(implausible_in(fisheye).empty());
  Camera sizeless = plausible();
  sizeless.width = sizeless.height = 0;
  EXPECT_TRUE(implausible_in(sizeless).empty());
}

TEST(CameraCheck, NamesWhatIsHardlyRight) {
  Camera camera = plausible();
  camera.cx = 20;
  expect_warning(camera, "cx");
  camera = plausible();
  camera.cy = 470;
  expect_warning(camera, "cy");
  camera = plausible();
  camera.fy = 350;
  expect_warning(camera, "fx, fy");
  camera = plausible();
  camera.fx = camera.fy = 16;  // mm
  camera.distortion = {};
  expect_warning(camera, "fx");
  camera = plausible();
  camera.skew = 20;
  expect_warning(camera, "skew");
  camera = plausible();
  camera.distortion = {-0.25, 0.12, 0.06, 0.001};
  expect_warning(camera, "p1");
  camera = plausible();
  camera.distortion = {-1.5};
  expect_warning(camera, "distortion");
}

TEST(CameraCheck, ViewOfAPinhole) {
  const Camera camera{640, 480, 320, 240, 319.5, 239.5, {}};
  EXPECT_NEAR(horizontal_view_rad(camera), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(vertical_view_rad(camera), std::numbers::pi / 2, 1e-12);
}

}  // namespace
}  // namespace edgescout
