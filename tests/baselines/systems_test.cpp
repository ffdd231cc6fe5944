// The systems that the baselines solve, compared with differences of their cost, in two views from
// different sides.
#include <gtest/gtest.h>

#include <functional>

#include "host/baselines/icp.h"
#include "host/baselines/methods.h"
#include "tests/baselines/random_edges.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

// A pose in front of two cameras and points that project well inside both images.
class Systems : public ::testing::Test {
 protected:
  Systems() {
    const Camera camera = scene_camera();
    for (const double x : {0.1, -0.25}) {
      ObjectView view;
      view.camera = camera;
      view.camera_from_world = camera_looking_at({x, 0.2, 0.45}, pose.translation_m);
      view.tensor =
          backend->make_view({}, camera.width, camera.height, {}, intrinsics_of(camera), {});
      views.push_back(view);
      points.emplace_back();
      for (int i = 0; i < 40; ++i) points.back().push_back(random_point(random, 0.05));
    }
  }

  // A plane over the image, so that values between pixels are known.
  static ScalarImage slope(int width, int height, double base, double by_x, double by_y) {
    ScalarImage image{width, height, std::vector<float>(std::size_t(width) * height)};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        image.values[std::size_t(y) * width + x] = float(base + by_x * x + by_y * y);
    return image;
  }

  // Poses are rounded to single precision: the steps are long enough for that.
  void expect_gradient(const std::function<WorldSystem(const Se3&)>& system_at) {
    const WorldSystem system = system_at(pose);
    EXPECT_EQ(system.points, 80);
    for (int i = 0; i < 6; ++i) {
      const Vector6d step = 1e-3 * Vector6d::Unit(i);
      const double slope =
          (system_at(retract(pose, step)).cost - system_at(retract(pose, -step)).cost) / 2e-3;
      EXPECT_NEAR(system.gradient[i], slope, 2e-3 * system.gradient.norm()) << i;
    }
  }

  Random random = test_random();
  std::unique_ptr<Backend> backend = make_cpu_backend(1);
  Se3 pose{random.rotation(), {0.02, -0.01, 0.03}};
  std::vector<ObjectView> views;
  std::vector<std::vector<ModelPoint>> points;
};

TEST_F(Systems, OfPairsDeriveTheirCost) {
  const std::vector<EdgePoint> edges = random_edges(80, 480, 360, random);
  Pairs pairs;
  for (int v = 0; v < 2; ++v) {
    pairs.emplace_back();
    for (int i = 0; i < 40; ++i) pairs[v].push_back(&edges[40 * v + i]);
  }
  // All of the loss's branches: squares alone, the linear part alone, both.
  for (const double scale : {1e3, 1e-3, 120.0})
    expect_gradient([&](const Se3& at) { return pair_system(views, points, pairs, at, scale); });
}

TEST_F(Systems, OfDistancesDeriveTheirCost) {
  const std::vector<ScalarImage> distances{slope(480, 360, 5, 0.02, 0.01),
                                           slope(480, 360, 20, -0.03, 0.015)};
  for (const double scale : {1e3, 1e-3, 12.0})
    expect_gradient(
        [&](const Se3& at) { return distance_system(views, points, distances, at, scale); });
}

// An image of 6 px: nearly all points project outside, and their distance to it pulls them back.
TEST_F(Systems, OfDistancesPullBackFromOutside) {
  const std::vector<ScalarImage> distances{slope(6, 6, 3, 0, 0), slope(6, 6, 3, 0, 0)};
  expect_gradient([&](const Se3& at) { return distance_system(views, points, distances, at, 50); });
}

TEST_F(Systems, OfMagnitudesDeriveTheirCostOnEveryLevel) {
  const MagnitudePyramid pyramid{slope(480, 360, 0.1, 1e-3, -2e-4),
                                 slope(240, 180, 0.6, -1e-3, 2e-3)};
  const std::vector<MagnitudePyramid> pyramids{pyramid, {pyramid[0]}};
  for (const int level : {0, 1})
    expect_gradient(
        [&](const Se3& at) { return magnitude_system(views, points, pyramids, level, at); });
}

TEST_F(Systems, LeaveOutPointsWithoutAnEdge) {
  const EdgePoint edge{100, 100, 0, 1};
  Pairs pairs(2, std::vector<const EdgePoint*>(40, nullptr));
  pairs[1][7] = &edge;
  const WorldSystem system = pair_system(views, points, pairs, pose, 4);
  const Landing at =
      land(views[1].tensor->intrinsics, views[1].camera_from_world * pose, points[1][7]);
  EXPECT_EQ(system.points, 1);
  EXPECT_NEAR(system.residual_sum, std::hypot(at.u - 100, at.v - 100), 1e-3);
}

}  // namespace
}  // namespace edgescout
