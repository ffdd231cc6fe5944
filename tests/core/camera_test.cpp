#include "host/core/camera.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "kernels/error.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

Camera camera() { return {640, 480, 570, 590, 311.5, 250.25, {}}; }

TEST(Camera, ProjectsByHand) {
  // x = fx X / Z + cx.
  EXPECT_EQ(project(camera(), {0, 0, 2}), Eigen::Vector2d(311.5, 250.25));
  EXPECT_NEAR((project(camera(), {0.1, -0.2, 0.5}) - Eigen::Vector2d(425.5, 14.25)).norm(), 0,
              1e-12);
}

TEST(Camera, RaysGoThroughTheirPixels) {
  Random random = test::test_random();
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d pixel(random.uniform(-50, 700), random.uniform(-50, 530));
    const Eigen::Vector3d ray = ray_through(camera(), pixel);
    EXPECT_EQ(ray.z(), 1);
    EXPECT_NEAR((project(camera(), random.uniform(0.1, 5) * ray) - pixel).norm(), 0, 1e-9);
  }
}

TEST(Camera, ScaledSeesTheSameBordersOfTheImage) {
  for (const double factor : {0.25, 0.5, 2.0, 1.5}) {
    const Camera small = scaled(camera(), factor);
    EXPECT_EQ(small.width, std::lround(640 * factor));
    EXPECT_EQ(small.height, std::lround(480 * factor));
    // The image covers [-0.5, width - 0.5): its corners are the same directions at every size.
    for (const double u : {0.0, 640.0})
      for (const double v : {0.0, 480.0}) {
        const Eigen::Vector3d full = ray_through(camera(), {u - 0.5, v - 0.5});
        const Eigen::Vector3d other = ray_through(small, {u * factor - 0.5, v * factor - 0.5});
        EXPECT_NEAR((full - other).norm(), 0, 1e-12) << factor;
      }
  }
}

TEST(Camera, ScalingThereAndBackChangesNothing) {
  const Camera back = scaled(scaled(camera(), 0.5), 2);
  EXPECT_EQ(back.width, 640);
  EXPECT_EQ(back.height, 480);
  EXPECT_NEAR(back.fx, 570, 1e-9);
  EXPECT_NEAR(back.fy, 590, 1e-9);
  EXPECT_NEAR(back.cx, 311.5, 1e-9);
  EXPECT_NEAR(back.cy, 250.25, 1e-9);
}

// A length across the line of sight in the middle of the image, projected.
TEST(Camera, SizeAndDistanceOfALengthBelongTogether) {
  const Camera camera{640, 480, 800, 800, 319.5, 239.5, {}};
  const Eigen::Vector3d left(-0.05, 0, 0.4), right(0.05, 0, 0.4);
  const double px = (project(camera, right) - project(camera, left)).norm();
  EXPECT_NEAR(size_px(0.1, 0.4, camera), px, 1e-9);
  EXPECT_NEAR(distance_at_size_m(0.1, px, camera), 0.4, 1e-12);
}

TEST(Camera, UndistortedForgetsTheLensOnly) {
  Camera bent = camera();
  EXPECT_FALSE(bent.has_distortion());
  bent.distortion[7] = 1e-3;
  EXPECT_TRUE(bent.has_distortion());
  const Camera ideal = undistorted(bent);
  EXPECT_FALSE(ideal.has_distortion());
  Camera fisheye = camera();
  fisheye.lens = LensModel::Fisheye;  // bends the image also where all coefficients are zero
  EXPECT_TRUE(fisheye.has_distortion());
  EXPECT_FALSE(undistorted(fisheye).has_distortion());
  Camera skewed = camera();
  skewed.skew = 0.1;
  EXPECT_TRUE(skewed.has_distortion());
  EXPECT_EQ(ideal.width, bent.width);
  EXPECT_EQ(ideal.fx, bent.fx);
  EXPECT_EQ(ideal.cy, bent.cy);
}

TEST(Camera, UndistortedHasTheChosenFieldOfView) {
  Camera wide = camera();
  wide.field_of_view_rad = std::numbers::pi / 2;
  EXPECT_TRUE(wide.has_distortion());
  const Camera ideal = undistorted(wide);
  // 45 degrees to the left and to the right border.
  EXPECT_NEAR(ray_through(ideal, {-0.5, 0}).x(), -1, 1e-12);
  EXPECT_NEAR(ray_through(ideal, {639.5, 0}).x(), 1, 1e-12);
  EXPECT_EQ(ideal.fx, ideal.fy);
  EXPECT_EQ(ideal.cy, 239.5);
  EXPECT_FALSE(ideal.has_distortion());
}

// Field and the name the error gives it.
template <typename Value>
void expect_refused(Value Camera::*field, Value bad, const std::string& name) {
  Camera broken = camera();
  broken.*field = bad;
  try {
    validate(broken, "scene.json");
    ADD_FAILURE() << name << " accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("scene.json: " + name + ": found ", 0), 0u)
        << error.what();
  }
}

TEST(Camera, ValidateNamesFileAndField) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(validate(camera(), "scene.json"));
  expect_refused(&Camera::width, 0, "width");
  expect_refused(&Camera::height, -480, "height");
  for (const double bad : {0.0, -570.0, nan, infinity}) {
    expect_refused(&Camera::fx, bad, "fx");
    expect_refused(&Camera::fy, bad, "fy");
  }
  for (const double bad : {-641.0, 1281.0, nan, infinity}) expect_refused(&Camera::cx, bad, "cx");
  for (const double bad : {-481.0, 961.0, nan, -infinity}) expect_refused(&Camera::cy, bad, "cy");
  for (const double bad : {-0.1, 3.2, nan})
    expect_refused(&Camera::field_of_view_rad, bad, "field of view");
  expect_refused(&Camera::skew, infinity, "skew");
  expect_refused(&Camera::distortion, {0, 0, 0, nan}, "distortion");
}

}  // namespace
}  // namespace edgescout
