#include "host/render/simulated_cell.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/active/views.h"
#include "host/register/measured_depth.h"
#include "host/render/renderer.h"
#include "kernels/thread_pool.h"
#include "tests/active/tiny_scene.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

struct Cell {
  ThreadPool pool{2};
  SimulatedScene scene = tiny_scene();
  std::vector<Se3> views = hemisphere_views({{0, 0, 0}, 0.3, {40, 70}, 6});
  SimulatedCell with(const ArmNoise& noise) {
    return {scene, scene.views[0].camera, views, noise, pool};
  }
};

bool same(const Se3& a, const Se3& b) {
  return distance_between_m(a, b) == 0 && a.rotation.coeffs() == b.rotation.coeffs();
}

TEST(SimulatedCell, RendersTheSceneFromThePlannedPlace) {
  Cell t;
  const Shot shot = t.with({}).acquire(3);
  EXPECT_TRUE(same(shot.camera_from_world, t.views[3]));
  SimulatedScene by_hand = t.scene;
  by_hand.views = {{t.scene.views[0].camera, t.views[3]}};
  by_hand.options.seed += 3;
  EXPECT_EQ(shot.image.pixels, render(by_hand, t.pool)[0].image.pixels);
}

TEST(SimulatedCell, GivesTheSameImageWhateverWasAskedBefore) {
  Cell t;
  const ArmNoise noise{0.002, 0.01, true, 5};
  SimulatedCell once = t.with(noise), again = t.with(noise);
  again.acquire(0);
  again.acquire(4);
  const Shot a = once.acquire(2), b = again.acquire(2);
  EXPECT_EQ(a.image.pixels, b.image.pixels);
  EXPECT_TRUE(same(a.camera_from_world, b.camera_from_world));
}

TEST(SimulatedCell, MissesThePlaceByTheArmsNoise) {
  Cell t;
  double shift2 = 0, turn2 = 0;
  const int draws = 60;
  for (int i = 0; i < draws; ++i) {
    ArmNoise noise{0.002, 0.01, true, static_cast<std::uint64_t>(i)};
    const Se3 error = t.with(noise).acquire(1).camera_from_world * inverse(t.views[1]);
    shift2 += error.translation_m.squaredNorm() / (3 * draws);
    turn2 += so3_log(error.rotation).squaredNorm() / (3 * draws);
  }
  // 180 draws: the standard deviation is known to 5 %.
  EXPECT_NEAR(std::sqrt(shift2), 0.002, 0.0004);
  EXPECT_NEAR(std::sqrt(turn2), 0.01, 0.002);
}

TEST(SimulatedCell, AnArmWithoutEncodersReportsThePlanAndSeesTheTruth) {
  Cell t;
  const ArmNoise hidden{0.01, 0.05, false, 2}, known{0.01, 0.05, true, 2};
  const Shot planned = t.with(hidden).acquire(1), reached = t.with(known).acquire(1);
  EXPECT_TRUE(same(planned.camera_from_world, t.views[1]));
  EXPECT_GT(distance_between_m(reached.camera_from_world, t.views[1]), 0.001);
  EXPECT_EQ(planned.image.pixels, reached.image.pixels);
  EXPECT_NE(planned.image.pixels, t.with({}).acquire(1).image.pixels);
}

TEST(SimulatedCell, StatesTheNoiseOfItsDepth) {
  Cell t;
  EXPECT_EQ(t.with({}).acquire(1).depth, nullptr);
  t.scene.options.depth.on = true;
  t.scene.options.depth.noise_m = 0.003;
  t.scene.options.depth.noise_floor_m = 0.007;
  const Shot shot = t.with({}).acquire(1);
  ASSERT_TRUE(shot.depth);
  EXPECT_EQ(shot.depth->noise.at_one_metre_m, 0.003);
  EXPECT_EQ(shot.depth->noise.floor_m, 0.007);
}

TEST(SimulatedCell, RefusesNoiseOutOfBounds) {
  Cell t;
  expect_input_error([&] { t.with({-1, 0}); }, {"arm_noise.translation_m"});
  expect_input_error([&] { t.with({0, NAN}); }, {"arm_noise.rotation_rad"});
}

}  // namespace
}  // namespace edgescout::test
