#include <gtest/gtest.h>

#include <cmath>

#include "host/core/lens.h"
#include "host/io/image.h"
#include "kernels/error.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/gradient_image.h"
#include "tests/lens.h"

namespace edgescout::test {
namespace {

// A smooth scene seen through the lens: the grey value at a distorted pixel is f(undistorted
// pixel).
double scene(double x, double y) { return 128 + 60 * std::sin(0.05 * x) + 60 * std::cos(0.04 * y); }

// Renders the scene through the lens, takes the lens out and compares. `ideal_of` gives the place
// in the undistorted image of a pixel of the original, `seen_of` the other way. Returns the number
// of pixels compared: those that the original shows well inside.
template <typename Ideal, typename Seen>
int expect_taken_out(const Camera& camera, const Ideal& ideal_of, const Seen& seen_of) {
  Image seen{camera.width, camera.height, {}};
  for (int y = 0; y < seen.height; ++y)
    for (int x = 0; x < seen.width; ++x) {
      const Eigen::Vector2d ideal = ideal_of(x, y);
      seen.pixels.push_back(static_cast<std::uint8_t>(std::lround(scene(ideal.x(), ideal.y()))));
    }
  const Image flat = undistort(seen, camera);
  EXPECT_EQ(flat.width, camera.width);
  int compared = 0;
  for (int y = 0; y < flat.height; ++y)
    for (int x = 0; x < flat.width; ++x) {
      const Eigen::Vector2d from = seen_of(x, y);
      if (from.x() < 3 || from.y() < 3 || from.x() > 196 || from.y() > 156) continue;
      // Rounding to grey levels twice, and remap's fixed-point coordinates of 1/32 px.
      EXPECT_NEAR(flat.at(x, y), scene(x, y), 1.5) << x << " " << y;
      ++compared;
    }
  return compared;
}

TEST(Undistort, TakesTheLensOutOfASmoothScene) {
  Camera camera{
      200, 160, 220, 210, 98.5, 82, {-0.2, 0.05, 0.002, -0.001, 0.01, 0.01, 0.005, 0.002}};
  const int compared = expect_taken_out(
      camera,
      [&](int x, int y) {
        return undistort_point(camera, {x, y});
      },
      [&](int x, int y) { return distort(camera, x, y); });
  EXPECT_GT(compared, 25000);
}

// The place in the undistorted image of what a pixel of the original shows.
Eigen::Vector2d ideal_place(const Camera& camera, const Eigen::Vector2d& seen) {
  const Camera ideal = undistorted(camera);
  Eigen::Vector2d place(ideal.cx, ideal.cy);
  Eigen::Vector2d off(1, 1);
  for (int i = 0; i < 200 && off.norm() > 1e-6; ++i) {
    const Eigen::Vector2d direction = ray_through(ideal, place).head<2>();
    off = seen - pixel_seeing(camera, direction);
    place += ideal.fx / camera.fx * off;
  }
  EXPECT_LT(off.norm(), 0.01);
  return place;
}

// With a skew, and with the pinhole of a chosen field of view.
TEST(Undistort, TakesOtherLensesOutOfASmoothScene) {
  Camera fisheye{200, 160, 150, 152, 98.5, 82, {-0.03, 0.01, -0.005, 0.001}};
  fisheye.lens = LensModel::Fisheye;
  fisheye.skew = 0.8;
  Camera chosen = fisheye;
  chosen.field_of_view_rad = 1.2;
  Camera plain = chosen;  // by OpenCV
  plain.lens = LensModel::BrownConrady;
  plain.skew = 0;
  for (const Camera& camera : {fisheye, chosen, plain}) {
    const int compared = expect_taken_out(
        camera,
        [&](int x, int y) {
          return ideal_place(camera, {x, y});
        },
        [&](int x, int y) {
          return pixel_seeing(camera, ray_through(undistorted(camera), {x, y}).head<2>());
        });
    EXPECT_GT(compared, 20000);
  }
}

TEST(Undistort, ReturnsTheImageWithoutDistortionAndRefusesAnotherSize) {
  const Image image = gradient_image(40, 30);
  Camera camera{40, 30, 50, 50, 20, 15, {}};
  EXPECT_EQ(undistort(image, camera).pixels, image.pixels);
  camera.width = 41;
  EXPECT_THROW(undistort(image, camera), LogicError);
}

TEST(Undistort, RefusesSizesItCannotWorkOn) {
  const Image image = gradient_image(40, 30);
  for (std::size_t pixels : {0u, 1199u, 1201u}) {
    Image other = image;
    other.pixels.resize(pixels);
    for (double k1 : {0.0, 0.1})
      expect_input_error(
          [&] {
            undistort(other, {40, 30, 50, 50, 20, 15, {k1}});
          },
          {"pixels", "found " + std::to_string(pixels), "1200", "40x30"});
  }
  for (const auto& [width, height] : {std::pair{32767, 16}, {16, 40000}}) {
    Camera camera{width, height, 5000, 5000, width / 2.0, height / 2.0, {0.01}};
    const Image large = gradient_image(width, height);
    expect_input_error(
        [&] { undistort(large, camera); },
        {"image", "size", std::to_string(width) + "x" + std::to_string(height), "32766"});
    camera.distortion = {};
    EXPECT_EQ(undistort(large, camera).width, width);
  }
  const Camera largest{32766, 16, 5000, 5000, 16383, 8, {0.01}};
  EXPECT_EQ(undistort(gradient_image(32766, 16), largest).width, 32766);
}

}  // namespace
}  // namespace edgescout::test
