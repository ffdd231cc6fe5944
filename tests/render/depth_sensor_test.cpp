// Each error of the depth sensor alone, on a box that is seen from straight above.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/render/renderer.h"
#include "host/render/solid.h"
#include "kernels/thread_pool.h"

namespace edgescout::test {
namespace {

constexpr double HEIGHT_M = 0.5, TOP_M = 0.47;  // from the camera to the board and to the box

DepthSensor without_errors() {
  DepthSensor sensor;
  sensor.on = true;
  sensor.noise_m = sensor.step_m = sensor.grazing_cosine = sensor.grazing_ramp = 0;
  sensor.saturation_grey = sensor.highlight = sensor.baseline_m = sensor.border_px = 0;
  return sensor;
}

// 40 x 40 x 30 mm on the board below the camera: pixels 66 to 134 and 41 to 109.
SimulatedScene box_scene(const DepthSensor& sensor) {
  SimulatedScene scene;
  scene.options.noise_grey = scene.options.blur_px = 0;
  scene.options.depth = sensor;
  Object box;
  box.mesh = extrude("box", {{{0, 0}, {40, 0}, {40, 40}, {0, 40}}, {}, {}, 30});
  scene.objects = {box};
  // A little aside: no edge of a triangle runs through pixels' centres.
  scene.placed.push_back({0, {Eigen::Quaterniond::Identity(), {2e-4, 1.3e-4, 0.015}}, {}, true});
  scene.lights.push_back({{0.02, 0.01, 0.9}, 0.8});
  scene.board = {2, 2, {100, 100, 100, 100}};
  scene.board_side_m = 1;
  SceneView view;
  view.camera.width = 201;
  view.camera.height = 151;
  view.camera.fx = view.camera.fy = 800;
  view.camera.cx = 100;
  view.camera.cy = 75;
  view.camera_from_world = {Eigen::Quaterniond(0, 1, 0, 0), {0, 0, HEIGHT_M}};
  scene.views = {view};
  return scene;
}

Rendering rendered(const SimulatedScene& scene, int threads = 2) {
  ThreadPool pool(threads);
  return render(scene, pool).front();
}

Rendering box_with(const DepthSensor& sensor) { return rendered(box_scene(sensor)); }

bool is_missing(const Rendering& r, std::size_t i) {
  return r.measured_depth.z_m[i] == DEPTH_MISSING;
}

// Of the errors of all pixels of the box, or of the board.
double standard_deviation(const Rendering& r, int placed) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < r.placed.size(); ++i)
    if (r.placed[i] == placed) {
      squares += std::pow(r.measured_depth.z_m[i] - r.depth_m[i], 2);
      ++count;
    }
  return std::sqrt(squares / count);
}

TEST(DepthSensor, MeasuresTheTrueDepthWithoutErrors) {
  const Rendering r = box_with(without_errors());
  EXPECT_EQ(r.measured_depth.z_m, r.depth_m);
  EXPECT_NEAR(r.measured_depth.at(100, 75), TOP_M, 1e-6);
  EXPECT_NEAR(r.measured_depth.at(10, 75), HEIGHT_M, 1e-6);
}

TEST(DepthSensor, IsOffByDefaultAndLeavesTheImage) {
  DepthSensor off;
  const Rendering without = box_with(off);
  EXPECT_TRUE(without.measured_depth.z_m.empty());
  off.on = true;
  EXPECT_EQ(box_with(off).image.pixels, without.image.pixels);
}

TEST(DepthSensor, NoiseGrowsWithTheSquareOfTheDistance) {
  DepthSensor sensor = without_errors();
  sensor.noise_m = 0.004;
  for (const double blur_px : {0.0, 1.0}) {
    sensor.noise_blur_px = blur_px;
    const Rendering r = box_with(sensor);
    const double board = 0.004 * HEIGHT_M * HEIGHT_M, top = 0.004 * TOP_M * TOP_M;
    EXPECT_NEAR(standard_deviation(r, -1), board, 0.03 * board) << blur_px;
    EXPECT_NEAR(standard_deviation(r, 0), top, 0.08 * top) << blur_px;
  }
}

TEST(DepthSensor, BlurredNoiseIsAlikeInNeighbours) {
  DepthSensor sensor = without_errors();
  sensor.noise_m = 0.004;
  const auto likeness = [&](double blur_px) {
    sensor.noise_blur_px = blur_px;
    const DepthImage depth = box_with(sensor).measured_depth;
    double products = 0, squares = 0;
    for (int y = 0; y < 30; ++y)  // board alone
      for (int x = 0; x + 1 < depth.width; ++x) {
        products += (depth.at(x, y) - HEIGHT_M) * (depth.at(x + 1, y) - HEIGHT_M);
        squares += std::pow(depth.at(x, y) - HEIGHT_M, 2);
      }
    return products / squares;
  };
  EXPECT_NEAR(likeness(0), 0, 0.06);
  EXPECT_NEAR(likeness(1), std::exp(-0.25), 0.06);  // of a Gaussian's square: exp(-d^2 / 4 sigma^2)
}

TEST(DepthSensor, TakesEqualStepsOfDisparity) {
  DepthSensor sensor = without_errors();
  sensor.step_m = 0.02;  // 5 mm at half a metre
  sensor.noise_m = 0.04;
  const Rendering r = box_with(sensor);
  std::set<long> steps;
  for (const float z_m : r.measured_depth.z_m) {
    const double disparity = 1 / (0.02 * z_m);
    EXPECT_NEAR(disparity, std::round(disparity), 1e-3);
    steps.insert(std::lround(disparity));
  }
  EXPECT_GT(steps.size(), 5u);
  EXPECT_LT(steps.size(), 30u);
  EXPECT_TRUE(steps.contains(100)) << "0.5 m";
}

TEST(DepthSensor, MissesGrazingSurfaces) {
  DepthSensor sensor = without_errors();
  sensor.grazing_cosine = 0.995;  // the corners are seen at 0.988
  const Rendering r = box_with(sensor);
  for (int y = 0; y < 151; ++y)
    for (int x = 0; x < 201; ++x) {
      const double cosine = 1 / std::hypot(1, (x - 100) / 800.0, (y - 75) / 800.0);
      EXPECT_EQ(r.measured_depth.at(x, y) == DEPTH_MISSING, cosine <= 0.995) << x << ", " << y;
    }
  sensor.grazing_cosine = 0.9;
  sensor.grazing_ramp = 0.2;  // half of what is seen from straight above
  const Rendering half = box_with(sensor);
  const auto missing = std::ranges::count(half.measured_depth.z_m, DEPTH_MISSING);
  EXPECT_NEAR(static_cast<double>(missing) / (201 * 151), 0.5, 0.1);
}

TEST(DepthSensor, MissesSaturatedPixels) {
  DepthSensor sensor = without_errors();
  const Rendering plain = box_with(sensor);
  const auto [least, most] = std::ranges::minmax(plain.image.pixels);
  ASSERT_LT(least + 10, most);
  sensor.saturation_grey = 0.5 * (least + most);
  const Rendering r = box_with(sensor);
  for (std::size_t i = 0; i < r.placed.size(); ++i)
    EXPECT_EQ(is_missing(r, i), r.image.pixels[i] >= sensor.saturation_grey);
}

// The lamp stands 0.87 m over the top, the camera 0.47 m: its mirror image lies at 0.35 of the way.
TEST(DepthSensor, MissesHighlightsWhereTheLampIsMirrored) {
  DepthSensor sensor = without_errors();
  sensor.highlight = 0.5;
  SimulatedScene scene = box_scene(sensor);
  scene.placed[0].material.specular = 0.001;
  scene.placed[0].material.shininess = 20000;
  const Rendering r = rendered(scene);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  int missing = 0;
  for (int y = 0; y < 151; ++y)
    for (int x = 0; x < 201; ++x)
      if (r.measured_depth.at(x, y) == DEPTH_MISSING) {
        middle += Eigen::Vector2d(x, y);
        ++missing;
        EXPECT_EQ(r.placed[static_cast<std::size_t>(y) * 201 + x], 0);
      }
  ASSERT_GT(missing, 20);
  ASSERT_LT(missing, 2000);
  middle /= missing;
  const double share = 0.47 / (0.47 + 0.87);
  EXPECT_NEAR(middle.x(), 100 + 800 * 0.02 * share / TOP_M, 1.5);
  EXPECT_NEAR(middle.y(), 75 - 800 * 0.01 * share / TOP_M, 1.5);
}

// The board left of the box (from pixel 66 on) lies in the shadow of a projector at the right, as
// far as a ray over the box's edge reaches: from x = -20 mm down to the board.
TEST(DepthSensor, MissesTheProjectorsShadowOnItsFarSide) {
  for (const double baseline_m : {0.1, -0.1}) {
    DepthSensor sensor = without_errors();
    sensor.baseline_m = baseline_m;
    const Rendering r = box_with(sensor);
    const double edge_m = 0.02 + 0.03 * (0.1 + 0.02) / TOP_M;
    const int side = baseline_m > 0 ? -1 : 1;
    int shadow = 0, elsewhere = 0;
    for (int x = 0; x < 201; ++x) {
      const bool in_shadow = r.placed[std::size_t{75} * 201 + x] < 0 && side * (x - 100) > 0 &&
                             side * (x - 100) < 800 * edge_m / HEIGHT_M;
      const bool missing = r.measured_depth.at(x, 75) == DEPTH_MISSING;
      shadow += in_shadow;
      elsewhere += in_shadow != missing;
    }
    EXPECT_GE(shadow, 8) << baseline_m;
    EXPECT_LE(elsewhere, 3) << baseline_m << ": the projector's raster is one pixel fine";
  }
}

TEST(DepthSensor, SmearsOrMissesBorders) {
  DepthSensor sensor = without_errors();
  sensor.border_px = 2;
  sensor.border_missing = 1;
  const Rendering r = box_with(sensor);
  sensor.border_missing = 0;
  const Rendering smeared = box_with(sensor);
  int between = 0;
  for (int y = 2; y < 149; ++y)
    for (int x = 2; x < 199; ++x) {
      const auto owner = [&](int u, int v) {
        return r.placed[static_cast<std::size_t>(v) * 201 + u];
      };
      bool border = false;
      for (int v = -2; v <= 2; ++v)
        for (int u = -2; u <= 2; ++u)
          if (std::hypot(u, v) <= 2) border = border || owner(x + u, y + v) != owner(x, y);
      EXPECT_EQ(r.measured_depth.at(x, y) == DEPTH_MISSING, border) << x << ", " << y;
      const float z_m = smeared.measured_depth.at(x, y);
      if (border)
        between += z_m > TOP_M + 0.001 && z_m < HEIGHT_M - 0.001;
      else
        EXPECT_EQ(z_m, smeared.depth_m[static_cast<std::size_t>(y) * 201 + x]);
    }
  EXPECT_GT(between, 500);
}

TEST(DepthSensor, FindsNoBordersOnASlope) {
  DepthSensor sensor = without_errors();
  sensor.border_px = 2;
  SimulatedScene scene = box_scene(sensor);
  scene.placed.clear();
  scene.views[0].camera_from_world =
      Se3{so3_exp({0.6, 0.2, 0}), {0, 0, 0}} * scene.views[0].camera_from_world;
  const Rendering r = rendered(scene);
  EXPECT_EQ(r.measured_depth.z_m, r.depth_m);
}

TEST(DepthSensor, MissesAShareOfThePartsInBlobs) {
  DepthSensor sensor = without_errors();
  sensor.holes = 1.0 / 3;
  const Rendering r = box_with(sensor);
  int parts = 0, missing = 0, alike = 0;
  for (std::size_t i = 0; i + 1 < r.placed.size(); ++i) {
    parts += r.placed[i] == 0;
    missing += is_missing(r, i);
    alike += is_missing(r, i) && is_missing(r, i + 1);
    if (r.placed[i] < 0) {
      EXPECT_FALSE(is_missing(r, i));
    }
  }
  EXPECT_EQ(missing, std::lround(parts / 3.0));
  EXPECT_GT(alike, 0.8 * missing);
}

TEST(DepthSensor, ShiftsByTheBias) {
  DepthSensor sensor = without_errors();
  sensor.bias_m = -0.005;
  const Rendering r = box_with(sensor);
  EXPECT_NEAR(r.measured_depth.at(100, 75), TOP_M - 0.005, 1e-6);
  EXPECT_NEAR(r.measured_depth.at(10, 75), HEIGHT_M - 0.005, 1e-6);
}

// Of a turn about the camera's centre a plane keeps its distance, and its normal turns.
TEST(DepthSensor, TurnsWhatItMeasured) {
  DepthSensor sensor = without_errors();
  sensor.rotation_deg = 1;
  SimulatedScene scene = box_scene(sensor);
  scene.placed.clear();
  const DepthImage depth = rendered(scene).measured_depth;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 20; y < 131; ++y)
    for (int x = 20; x < 181; ++x) {
      const Eigen::Vector3d point_m =
          depth.at(x, y) * ray_through(scene.views[0].camera, Eigen::Vector2d(x, y));
      squares += point_m * point_m.transpose();
      sum += point_m;
    }
  const Eigen::Vector3d plane = squares.ldlt().solve(sum);  // plane . point = 1
  EXPECT_NEAR(1 / plane.norm(), HEIGHT_M, 1e-4);
  const double angle_rad = std::acos(plane.normalized().z());
  EXPECT_GT(angle_rad, 1e-3);
  EXPECT_LT(angle_rad, 1.001 * 3.14159265 / 180);
}

TEST(DepthSensor, MissesWhatIsOutOfRange) {
  DepthSensor sensor = without_errors();
  sensor.range_m = {0.3, 0.48};
  const Rendering r = box_with(sensor);
  EXPECT_NEAR(r.measured_depth.at(100, 75), TOP_M, 1e-6);
  EXPECT_EQ(r.measured_depth.at(10, 75), DEPTH_MISSING);
}

TEST(DepthSensor, DependsOnTheSeedAndNotOnThreads) {
  DepthSensor sensor;
  sensor.on = true;
  sensor.holes = 0.2;
  SimulatedScene scene = box_scene(sensor);
  const DepthImage first = rendered(scene, 1).measured_depth;
  EXPECT_EQ(rendered(scene, 3).measured_depth.z_m, first.z_m);
  scene.options.depth.holes = 0;  // the other errors stay as they are
  const DepthImage whole = rendered(scene).measured_depth;
  for (std::size_t i = 0; i < first.z_m.size(); ++i)
    EXPECT_TRUE(first.z_m[i] == DEPTH_MISSING || first.z_m[i] == whole.z_m[i]);
  ++scene.options.seed;
  EXPECT_NE(rendered(scene).measured_depth.z_m, whole.z_m);
}

}  // namespace
}  // namespace edgescout::test
