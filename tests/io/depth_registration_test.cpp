#include "host/io/depth_registration.h"

#include <gtest/gtest.h>

#include "kernels/thread_pool.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

Camera depth_camera() { return {160, 120, 200, 200, 79.5, 59.5, {}}; }

// A wall 1 m away; before it, where `is_near` says, a plate at 0.5 m.
template <typename IsNear>
DepthImage wall_and_plate(const IsNear& is_near) {
  DepthImage depth{160, 120, {}};
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) depth.z_m.push_back(is_near(x, y) ? 0.5f : 1.0f);
  return depth;
}

const auto nothing_near = [](int, int) { return false; };

TEST(DepthRegistration, ASensorAtTheCamerasPlaceChangesNothing) {
  ThreadPool pool(1);
  const DepthImage depth = wall_and_plate(nothing_near),
                   found = register_depth(depth, {depth_camera(), {}}, depth_camera(), pool);
  int same = 0;
  for (std::size_t i = 0; i < depth.z_m.size(); ++i)
    same += std::abs(found.z_m[i] - depth.z_m[i]) < 1e-5f;
  EXPECT_GT(same, 0.97 * double(depth.z_m.size()));  // the border's pixels may fall beside it
}

TEST(DepthRegistration, AnotherResolutionSeesTheSameWall) {
  ThreadPool pool(1);
  const Camera grey{640, 480, 800, 800, 319.5, 239.5, {}};
  const DepthImage found =
      register_depth(wall_and_plate(nothing_near), {depth_camera(), {}}, grey, pool);
  ASSERT_EQ(found.width, 640);
  for (const auto& [x, y] : {std::pair{320, 240}, {10, 10}, {600, 470}})
    EXPECT_NEAR(found.at(x, y), 1.0f, 1e-5f) << x << ", " << y;
}

// Seen from 0.1 m to the left, the plate moves right by 40 px and the wall by 20 px. A strip of the
// wall beside the plate was hidden from the sensor.
TEST(DepthRegistration, NearSurfacesHideFarOnesAndLeaveAShadow) {
  ThreadPool pool(1);
  const auto is_near = [](int x, int y) { return x >= 40 && x < 80 && y >= 40 && y < 80; };
  const DepthImage found = register_depth(
      wall_and_plate(is_near), {depth_camera(), {Eigen::Quaterniond::Identity(), {0.1, 0, 0}}},
      depth_camera(), pool);
  EXPECT_NEAR(found.at(100, 60), 0.5f, 1e-5f) << "the plate";
  EXPECT_NEAR(found.at(130, 60), 1.0f, 1e-5f) << "the wall on its right";
  EXPECT_EQ(found.at(70, 60), DEPTH_MISSING) << "the wall that the plate hid from the sensor";
  EXPECT_NEAR(found.at(40, 60), 1.0f, 1e-5f) << "the wall on its left";
  EXPECT_EQ(found.at(5, 60), DEPTH_MISSING) << "beside the sensor's image";
}

// Between the plate and the wall there is no surface.
TEST(DepthRegistration, DoesNotBridgeJumps) {
  ThreadPool pool(1);
  const auto is_near = [](int x, int) { return x < 80; };
  const DepthImage found = register_depth(
      wall_and_plate(is_near), {depth_camera(), {Eigen::Quaterniond::Identity(), {-0.05, 0, 0}}},
      depth_camera(), pool);
  for (const float z_m : found.z_m)
    EXPECT_TRUE(z_m == DEPTH_MISSING || std::abs(z_m - 0.5f) < 1e-4f || std::abs(z_m - 1) < 1e-4f)
        << z_m;
}

TEST(DepthRegistration, UndistortsToTheNearestPixel) {
  Camera camera = depth_camera();
  camera.distortion = {-0.2};
  const DepthImage found =
      undistort_depth(wall_and_plate([](int x, int) { return x < 80; }), camera);
  EXPECT_EQ(found.at(79, 59), 0.5f);
  EXPECT_EQ(found.at(80, 59), 1.0f);
  for (const float z_m : found.z_m)
    EXPECT_TRUE(z_m == DEPTH_MISSING || z_m == 0.5f || z_m == 1) << "no mean of two surfaces";
}

TEST(DepthRegistration, RefusesAnotherSize) {
  Camera camera = depth_camera();
  camera.width = 320;
  expect_input_error([&] { undistort_depth(wall_and_plate(nothing_near), camera); },
                     {"160x120", "320x120", "depth_camera"});
}

}  // namespace
}  // namespace edgescout::test
