// Surfaces that depth images measured, as other cameras see them, and the space that none measured.
#include "host/active/measured_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/active/unmeasured_space.h"
#include "host/active/views.h"
#include "host/register/measured_depth.h"
#include "kernels/thread_pool.h"

namespace edgescout::test {
namespace {

// A wall at z = 0 across the right half of the world (x > 0), a floor at z = -0.2 elsewhere.
constexpr double FLOOR_M = -0.2;

struct WallAndFloor {
  Camera camera{320, 240, 300, 300, 159.5, 119.5, {}};
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  Se3 from_above = look_at({0, 0, 1}, {0, 0, 0});
  Workspace workspace{{Eigen::Vector3d(-0.1, -0.1, -0.1), Eigen::Vector3d(0.1, 0.1, 0.1)}, {}, {}};

  double depth_along(const Se3& camera_from_world, const Eigen::Vector2d& pixel) const {
    const Se3 world_from_camera = inverse(camera_from_world);
    const Eigen::Vector3d eye_m = world_from_camera.translation_m,
                          ray = world_from_camera.rotation * ray_through(camera, pixel);
    const double to_wall = -eye_m.z() / ray.z();
    return (eye_m + to_wall * ray).x() > 0 ? to_wall : (FLOOR_M - eye_m.z()) / ray.z();
  }
  ObjectView view(const Se3& camera_from_world) const {
    ObjectView seen;
    seen.camera = camera;
    seen.camera_from_world = camera_from_world;
    MeasuredDepth depth{{camera.width, camera.height, {}}, {}};
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        depth.image.z_m.push_back(float(depth_along(camera_from_world, {x, y})));
    seen.depth = std::make_shared<const MeasuredDepth>(std::move(depth));
    return seen;
  }
  ObjectView view_without_values() const {
    ObjectView seen = view(from_above);
    const std::size_t pixels = seen.depth->image.z_m.size();
    seen.depth = std::make_shared<const MeasuredDepth>(
        MeasuredDepth{{camera.width, camera.height, std::vector<float>(pixels)}, {}});
    return seen;
  }
};

TEST(MeasuredSurfaces, LieWhereTheyWereMeasuredFromAnotherCamera) {
  const WallAndFloor t;
  const ObjectView measured = t.view(t.from_above);
  const Se3 aside = look_at({0.5, 0.2, 0.8}, {0.1, 0, 0});
  const std::vector<Occluders> seen =
      measured_surfaces({&measured, 1}, t.camera, {&aside, 1}, *t.backend);
  ASSERT_EQ(seen.size(), 1u);
  std::size_t there = 0, right = 0;
  for (int y = 0; y < t.camera.height; ++y)
    for (int x = 0; x < t.camera.width; ++x) {
      const float found_m =
          seen[0].depth_m[std::size_t(y) * std::size_t(t.camera.width) + std::size_t(x)];
      const double true_m = t.depth_along(aside, {x, y});
      if (found_m == DEPTH_EMPTY) continue;
      ++there;
      right += std::abs(found_m - true_m) < 2e-3;
      // Where the wall was not measured, it does not hide the floor.
      EXPECT_GT(found_m, true_m - 2e-3) << x << " " << y;
    }
  EXPECT_GT(there, seen[0].depth_m.size() / 2);
  EXPECT_GT(right, there * 9 / 10);
}

TEST(MeasuredSurfaces, HideWhatIsBehindThem) {
  const WallAndFloor t;
  const ObjectView measured = t.view(t.from_above);
  const Se3 aside = look_at({0.4, 0, 0.9}, {0.1, 0, 0});
  const std::vector<Occluders> seen =
      measured_surfaces({&measured, 1}, t.camera, {&aside, 1}, *t.backend);
  EXPECT_TRUE(seen[0].hide(aside * Eigen::Vector3d(0.1, 0, -0.1), 0.01));
  EXPECT_FALSE(seen[0].hide(aside * Eigen::Vector3d(0.1, 0, 0.005), 0.01));
  EXPECT_FALSE(seen[0].hide(aside * Eigen::Vector3d(-0.15, 0, FLOOR_M + 0.02), 0.01));
}

TEST(MeasuredSurfaces, HaveHolesWhereNothingWasMeasured) {
  const WallAndFloor t;
  EXPECT_TRUE(measured_surfaces({}, t.camera, {&t.from_above, 1}, *t.backend).empty());
  const ObjectView nothing = t.view_without_values();
  EXPECT_FALSE(has_measured_depth(nothing));
  EXPECT_TRUE(measured_surfaces({&nothing, 1}, t.camera, {&t.from_above, 1}, *t.backend).empty());
  ObjectView half = t.view(t.from_above);
  MeasuredDepth depth = *half.depth;
  for (int y = 0; y < t.camera.height; ++y)
    std::fill_n(depth.image.z_m.begin() + y * t.camera.width, t.camera.width / 2, DEPTH_MISSING);
  half.depth = std::make_shared<const MeasuredDepth>(std::move(depth));
  const std::vector<Occluders> seen =
      measured_surfaces({&half, 1}, t.camera, {&t.from_above, 1}, *t.backend);
  const std::size_t row = std::size_t(t.camera.width) * 120;
  EXPECT_EQ(seen[0].depth_m[row + 100], DEPTH_EMPTY);
  EXPECT_NEAR(seen[0].depth_m[row + 200], t.depth_along(t.from_above, {200, 120}), 1e-3);
}

TEST(UnmeasuredSpace, IsBehindWhatWasMeasured) {
  const WallAndFloor t;
  ThreadPool pool(2);
  const ObjectView measured = t.view(t.from_above);
  const UnmeasuredSpace space = unmeasured_space({&measured, 1}, t.workspace, pool);
  // Below the wall; from straight above the border throws no shadow at x = 0.
  const double volume_m3 = double(space.middle_m.size()) * std::pow(space.cell_m, 3);
  EXPECT_NEAR(volume_m3, 0.1 * 0.2 * 0.1, 2e-4);
  for (const Eigen::Vector3d& middle_m : space.middle_m) {
    EXPECT_GT(middle_m.x(), -space.cell_m);
    EXPECT_LT(middle_m.z(), 0);
  }
  const ObjectView nothing = t.view_without_values();
  EXPECT_NEAR(double(unmeasured_space({&nothing, 1}, t.workspace, pool).middle_m.size()) *
                  std::pow(space.cell_m, 3),
              0.008, 1e-6);
}

TEST(UnmeasuredSpace, IsSeenBesideTheSurfaceThatHidesIt) {
  const WallAndFloor t;
  ThreadPool pool(2);
  const ObjectView measured = t.view(t.from_above);
  const UnmeasuredSpace space = unmeasured_space({&measured, 1}, t.workspace, pool);
  const auto seen_m3 = [&](const Se3& view) {
    const Occluders surfaces =
        measured_surfaces({&measured, 1}, t.camera, {&view, 1}, *t.backend)[0];
    return volume_seen_m3(space, surfaces, view);
  };
  const double all_m3 = double(space.middle_m.size()) * std::pow(space.cell_m, 3);
  // Cells at the wall and within two pixels of its border are not hidden by it.
  EXPECT_LT(seen_m3(t.from_above), 0.3 * all_m3);
  // From the side of the floor one looks below the wall.
  EXPECT_GT(seen_m3(look_at({-0.8, 0, 0.1}, {0, 0, -0.05})), 0.9 * all_m3);
  EXPECT_EQ(seen_m3(look_at({0, 0, 1}, {0, 0, 2})), 0);  // away from it
}

TEST(Workspace, IsTheBallThatAllViewsSee) {
  const Camera camera{320, 240, 300, 300, 159.5, 119.5, {}};
  const std::vector<Se3> views = hemisphere_views({{0.1, 0, 0}, 0.5, {35, 70}, 10});
  const std::optional<Workspace> ball = workspace_of({}, views, camera);
  ASSERT_TRUE(ball);
  EXPECT_LT((ball->box_m.center() - Eigen::Vector3d(0.1, 0, 0)).norm(), 1e-6);
  EXPECT_NEAR(*ball->radius_m, 0.5 * std::sin(std::atan(120.0 / 300)), 1e-9);
  EXPECT_FALSE(workspace_of({}, std::span(views).first(1), camera));
}

TEST(Workspace, IsTheBoxOfThePrior) {
  WorldPrior prior;
  prior.box_m = {0, 0, 0, 0.2, 0.1, 0.1};
  prior.prior_from_world = {Eigen::Quaterniond::Identity(), {1, 0, 0}};
  const std::optional<Workspace> box = workspace_of(prior, {}, {320, 240, 300, 300, 160, 120, {}});
  ASSERT_TRUE(box);
  EXPECT_FALSE(box->radius_m);
  ThreadPool pool(2);
  const UnmeasuredSpace space = unmeasured_space({}, *box, pool);
  EXPECT_NEAR(double(space.middle_m.size()) * std::pow(space.cell_m, 3), 0.002, 2e-4);
  for (const Eigen::Vector3d& middle_m : space.middle_m)
    EXPECT_TRUE(middle_m.x() > -1 && middle_m.x() < -0.79) << middle_m.transpose();
}

}  // namespace
}  // namespace edgescout::test
