#include "host/active/views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/core/camera.h"
#include "host/core/random.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr double DEGREES = 180 / std::numbers::pi;

TEST(Hemisphere, LooksAtTheCentreFromItsRadius) {
  HemisphereOptions options;
  options.center_m = {0.1, -0.2, 0.3};
  options.radius_m = 0.7;
  options.elevations_deg = {20, 50, 90};
  options.count = 21;
  const std::vector<Se3> views = hemisphere_views(options);
  ASSERT_EQ(views.size(), 21u);
  int seen[3] = {0, 0, 0};
  for (const Se3& view : views) {
    const Eigen::Vector3d eye = inverse(view).translation_m, off = eye - options.center_m;
    EXPECT_NEAR(off.norm(), 0.7, 1e-9);
    EXPECT_LT((view * options.center_m - Eigen::Vector3d(0, 0, 0.7)).norm(), 1e-9);
    const double elevation = std::asin(off.z() / 0.7) * DEGREES;
    int ring = -1;
    for (int r = 0; r < 3; ++r)
      if (std::abs(elevation - options.elevations_deg[r]) < 1e-6) ring = r;
    ASSERT_GE(ring, 0) << elevation;
    ++seen[ring];
    // +z of the world points up in the image, that is to smaller y, and the horizon is level.
    const Eigen::Vector3d up = view.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_LT(up.y(), ring < 2 ? -0.1 : 1e-9);
    EXPECT_NEAR(up.x(), 0, 1e-9);
  }
  // By circumference: cos 20 : cos 50 = 0.94 : 0.64, and one straight above.
  EXPECT_EQ(seen[2], 1);
  EXPECT_NEAR(double(seen[0]) / seen[1], 0.94 / 0.643, 0.25);
}

TEST(Hemisphere, SpreadsARingEvenly) {
  HemisphereOptions options;
  options.elevations_deg = {40};
  options.count = 8;
  const std::vector<Se3> views = hemisphere_views(options);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Eigen::Vector3d a = inverse(views[i]).translation_m,
                          b = inverse(views[(i + 1) % 8]).translation_m;
    EXPECT_NEAR((a - b).norm(), 2 * 0.5 * std::cos(40 / DEGREES) * std::sin(std::numbers::pi / 8),
                1e-9);
  }
}

TEST(Hemisphere, RefusesOptionsWithoutViews) {
  const auto with = [](auto change) {
    return [change] {
      HemisphereOptions options;
      change(options);
      hemisphere_views(options);
    };
  };
  expect_input_error(with([](HemisphereOptions& o) { o.radius_m = 0; }), {"views.radius"});
  expect_input_error(with([](HemisphereOptions& o) { o.elevations_deg.clear(); }),
                     {"views.elevations"});
  expect_input_error(with([](HemisphereOptions& o) { o.elevations_deg = {95}; }),
                     {"views.elevations", "95"});
  expect_input_error(with([](HemisphereOptions& o) { o.count = 2; }), {"views.count", "2"});
  expect_input_error(with([](HemisphereOptions& o) { o.center_m.x() = std::nan(""); }),
                     {"views.center"});
  // More than one camera straight above the centre: two views that are one.
  expect_input_error(with([](HemisphereOptions& o) { o.elevations_deg = {90}, o.count = 2; }),
                     {"same pose"});
  expect_input_error([] { look_at({1, 2, 3}, {1, 2, 3}); }, {"two different points"});
}

TEST(ViewList, ComesBackFromItsFile) {
  TemporaryFolder folder;
  Random random = test_random();
  std::vector<Se3> views;
  for (int i = 0; i < 7; ++i)
    views.push_back({random.rotation(), random.uniform(0.5, 2) * random.direction()});
  save_views(views, folder.path() / "views.json");
  const std::vector<Se3> back = load_views(folder.path() / "views.json");
  ASSERT_EQ(back.size(), views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_LT(distance_between_m(views[i], back[i]), 1e-12);
    EXPECT_LT(angle_between_rad(views[i], back[i]), 1e-9);
  }
}

TEST(ViewList, NamesFileAndFieldOfWhatIsWrong) {
  TemporaryFolder folder;
  const std::string good = R"({"camera_from_world": {"R": [1,0,0,0,1,0,0,0,1], "t": [0,0,0.5]}})";
  const auto load = [&](const std::string& text) {
    const std::string file = folder.write("list.json", text);
    return [file] { load_views(file); };
  };
  EXPECT_NO_THROW(load("[" + good + "]")());
  expect_input_error(load("[]"), {"list.json", "views", "none"});
  expect_input_error(load("{}"), {"list.json", "array"});
  expect_input_error(load("[" + good + "," + good + "]"),
                     {"list.json", "/1/camera_from_world", "view 0"});
  expect_input_error(load(R"([{"pose": 1}])"), {"list.json", "/0/camera_from_world"});
  expect_input_error(
      load(R"([{"camera_from_world": {"R": [1,0,0,0,1,0,0,0,1.1], "t": [0,0,0.5]}}])"),
      {"list.json", "/0/camera_from_world/R", "no rotation"});
  expect_input_error(
      load(R"([{"camera_from_world": {"R": [1,0,0,0,1,0,0,0,-1], "t": [0,0,0.5]}}])"),
      {"list.json", "/0/camera_from_world/R", "no rotation"});
  expect_input_error(load(R"([{"camera_from_world": {"R": [1,0,0,0,1,0,0,0,1], "t": [0,0]}}])"),
                     {"list.json", "/0/camera_from_world/t", "2 numbers"});
  expect_input_error([&] { load_views(folder.path() / "none.json"); }, {"none.json"});
}

TEST(ViewList, ValidatesViewsInMemory) {
  Se3 odd;
  odd.rotation.coeffs() *= 1.1;
  expect_input_error([&] { validate_views(std::vector<Se3>{odd}, "robot"); },
                     {"robot", "/0/", "quaternion"});
  Se3 lost;
  lost.translation_m.y() = std::nan("");
  expect_input_error(
      [&] {
        validate_views(std::vector<Se3>{Se3{}, lost}, "robot");
      },
      {"robot", "/1/", "not finite"});
  Se3 near;
  near.translation_m.x() = 2e-4;
  EXPECT_NO_THROW(validate_views(std::vector<Se3>{Se3{}, near}, "robot"));
}

TEST(LookedAt, IsWhereTheAxesMeet) {
  HemisphereOptions options;
  options.center_m = {0.1, -0.2, 0.3};
  const auto point_m = looked_at_m(hemisphere_views(options));
  ASSERT_TRUE(point_m);
  EXPECT_LT((*point_m - options.center_m).norm(), 1e-9);
}

// In any direction of the world's axes.
TEST(DirectionAbove, IsWhereTheCamerasStand) {
  HemisphereOptions options;
  options.center_m = {0.1, -0.2, 0.3};
  std::vector<Se3> views = hemisphere_views(options);
  const auto above = direction_above(directions_to(views, options.center_m));
  ASSERT_TRUE(above);
  EXPECT_LT((*above - Eigen::Vector3d::UnitZ()).norm(), 0.05);
  const Se3 turned_from_world{Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized(), {1, -2, 3}};
  for (Se3& view : views) view = view * inverse(turned_from_world);
  const auto turned = direction_above(directions_to(views, turned_from_world * options.center_m));
  ASSERT_TRUE(turned);
  EXPECT_LT((*turned - turned_from_world.rotation * *above).norm(), 1e-9);
  const std::vector<Se3> around{look_at({0.5, 0, 0}, {0, 0, 0}), look_at({-0.5, 0, 0}, {0, 0, 0})};
  EXPECT_FALSE(direction_above(directions_to(around, {0, 0, 0})));
}

// The axes of a gantry's cameras, with 1 mrad of tilt, come nearest tens of metres away. Those of a
// head that pans and tilts meet in the cameras.
TEST(LookedAt, IsNothingWhereViewsHaveNoPointInCommon) {
  Random random(3);
  std::vector<Se3> one{look_at({0, 0, 0.5}, {0, 0, 0})}, gantry, head;
  for (int i = 0; i < 12; ++i) {
    Se3 down = one[0];
    const Eigen::Vector3d shift(0.05 * i, 0.02 * (i % 3), 0);
    down.rotation = so3_exp(1e-3 * random.direction()) * down.rotation;
    down.translation_m -= down.rotation * shift;
    gantry.push_back(down);
    head.push_back(look_at({0, 0, 0.5}, {0.02 * i, 0.1, 0}));
  }
  EXPECT_FALSE(looked_at_m(one));
  EXPECT_FALSE(looked_at_m(gantry));
  EXPECT_FALSE(looked_at_m(head));
}

}  // namespace
}  // namespace edgescout::test
