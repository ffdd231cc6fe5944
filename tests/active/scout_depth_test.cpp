// Active detection with depth images.
#include <gtest/gtest.h>

#include "host/active/candidates.h"
#include "host/active/weigh_particles.h"
#include "host/register/depth_evidence.h"
#include "tests/active/same_state.h"
#include "tests/active/small_cell.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

struct CellWithDepth : SmallCell {
  CellWithDepth() { scene.options.depth.on = true; }
  // The views of two images. `change` alters the depth of each.
  std::vector<ObjectView> prepared(const std::function<void(MeasuredDepth&)>& change = {}) {
    SimulatedCell cell = source();
    std::vector<ObjectView> prepared;
    for (const int view : {0, 3}) {
      const Shot shot = cell.acquire(view);
      prepared.push_back(prepare_view(shot.image, camera(), shot.camera_from_world, *backend, {}));
      MeasuredDepth depth = *shot.depth;
      if (change) change(depth);
      prepared.back().depth = std::make_shared<const MeasuredDepth>(std::move(depth));
      add_tensors(prepared.back(), sets, *backend, {});
    }
    return prepared;
  }
  Detection at_the_part(const Eigen::Vector3d& shift_m) const {
    Detection candidate;
    candidate.world_from_object = scene.placed[0].world_from_object;
    candidate.world_from_object.translation_m += shift_m;
    candidate.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    return candidate;
  }
};

// As if the sensor had seen through whatever stands on the board.
void remove_parts(MeasuredDepth& depth) {
  for (float& z_m : depth.image.z_m)
    if (z_m > 0) z_m += 0.05f;
}

TEST(ScoutDepth, IsWhatEveryShotMeasured) {
  CellWithDepth t;
  SimulatedCell cell = t.source();
  const Shot shot = cell.acquire(1);
  ASSERT_TRUE(shot.depth);
  EXPECT_EQ(shot.depth->image.width, t.camera().width);
  std::size_t measured = 0;
  for (const float z_m : shot.depth->image.z_m) measured += z_m > 0.2f && z_m < 0.4f;
  EXPECT_GT(measured, shot.depth->image.z_m.size() / 2);
  t.scene.options.depth.on = false;
  SimulatedCell grey = t.source();
  const Shot same = grey.acquire(1);
  EXPECT_FALSE(same.depth);
  EXPECT_EQ(same.image.pixels, shot.image.pixels);
}

TEST(ScoutDepth, FindsThePartAndContinuesFromASavedState) {
  CellWithDepth t;
  SimulatedCell cell = t.source();
  const TemporaryFolder folder;
  const auto file = folder.path() / "state";
  ScoutOptions options = SmallCell::options();
  options.max_views = 2;
  Scout whole = t.scout(options);
  run_scout(whole, cell, [&](const ScoutState& state) {
    if (state.steps.size() == 1) save_scout_state(state, file);
  });
  EXPECT_EQ(t.found(whole.state()), 1);
  Scout resumed = t.scout(options);
  resumed.resume(load_scout_state(file), file.string());
  const ScoutStep &before = whole.state().steps[0], &after = resumed.state().steps[0];
  ASSERT_TRUE(after.depth);
  EXPECT_EQ(after.depth->image.z_m, before.depth->image.z_m);
  EXPECT_EQ(after.depth->noise.at_one_metre_m, before.depth->noise.at_one_metre_m);
  const std::vector<Particle>&particles = resumed.state().particles,
        &saved = whole.state().steps[0].after;
  ASSERT_EQ(particles.size(), saved.size());
  std::size_t on_measured = 0;  // poses that the depth image confirms
  for (std::size_t i = 0; i < particles.size(); ++i) {
    EXPECT_EQ(particles[i].features[0].depth.agreeing, saved[i].features[0].depth.agreeing);
    on_measured += particles[i].features[0].depth.agreeing > 0;
  }
  EXPECT_GT(on_measured, particles.size() / 3);
  run_scout(resumed, cell);
  expect_same(whole.state(), resumed.state());
}

TEST(ScoutDepth, WithoutAnyValueChangesNothing) {
  CellWithDepth t;
  SimulatedCell cell = t.source();
  ScoutOptions options = SmallCell::options();
  options.max_views = 2;
  Scout with = t.scout(options), without = t.scout(options);
  for (Scout* scout : {&with, &without})
    while (const auto proposal = scout->propose()) {
      Shot shot = cell.acquire(proposal->view);
      MeasuredDepth nothing = *shot.depth;
      std::ranges::fill(nothing.image.z_m, DEPTH_MISSING);
      shot.depth = scout == &with ? std::make_shared<const MeasuredDepth>(nothing) : nullptr;
      scout->give(proposal->view, shot);
    }
  ASSERT_FALSE(without.state().detections.empty());
  expect_same(with.state(), without.state());
  EXPECT_EQ(with.state().steps[1].decision.views[4].discovery,
            without.state().steps[1].decision.views[4].discovery);
}

TEST(ScoutDepth, OfAnotherSizeIsRefused) {
  CellWithDepth t;
  SimulatedCell cell = t.source();
  Shot shot = cell.acquire(0);
  shot.depth = std::make_shared<const MeasuredDepth>(
      MeasuredDepth{{10, 20, std::vector<float>(200, 0.3f)}, {}});
  Scout scout = t.scout();
  expect_input_error([&] { scout.give(0, shot); }, {"depth image size", "10x20", "320x240"});
  shot.depth =
      std::make_shared<const MeasuredDepth>(MeasuredDepth{{320, 240, std::vector<float>(7)}, {}});
  expect_input_error([&] { scout.give(0, shot); }, {"depth image", "7 pixels"});
  EXPECT_TRUE(scout.state().steps.empty());
}

// No combination has a candidate where the sensor saw through.
TEST(ScoutDepth, RemovesCandidatesThatItContradicts) {
  CellWithDepth t;
  const std::vector<Detection> candidates{t.at_the_part({0, 0, 0})};
  const auto refined = [&](const std::vector<ObjectView>& views) {
    const std::vector<EdgeModel> models = models_of(t.sets);
    DetectOptions options = SmallCell::options().pipeline.detect;
    return refined_candidates({models, views, *t.backend}, t.sets, candidates, 10, options);
  };
  EXPECT_EQ(refined(t.prepared()).size(), 1u);
  for (const Detection& kept : refined(t.prepared(remove_parts)))
    EXPECT_GT((kept.world_from_object.translation_m - candidates[0].world_from_object.translation_m)
                  .norm(),
              0.02);
}

TEST(ScoutDepth, TakesTheWeightOfParticlesThatItContradicts) {
  CellWithDepth t;
  const std::vector<EdgeModel> models = models_of(t.sets);
  const std::vector<Detection> candidates{t.at_the_part({0, 0, 0})};
  const auto living = [&](const std::vector<ObjectView>& views) {
    std::vector<Particle> particles =
        draw_particles(models, candidates, 8, {0.001, 0.002, 0.1}, Random(3));
    std::vector<double> unseen_px2;
    return weigh_particles({models, views, *t.backend}, particles, unseen_px2, {}).living;
  };
  EXPECT_EQ(living(t.prepared()), 8u);
  EXPECT_EQ(living(t.prepared(remove_parts)), 0u);
}

TEST(IsContradicted, NeedsMostOfWhatWasMeasured) {
  EXPECT_FALSE(is_contradicted({}));
  EXPECT_FALSE(is_contradicted({.contradicting = 19}));
  EXPECT_TRUE(is_contradicted({.contradicting = 20}));
  EXPECT_TRUE(is_contradicted({.agreeing = 50, .contradicting = 51}));
  EXPECT_FALSE(is_contradicted({.agreeing = 50, .contradicting = 50, .missing = 200}));
}

}  // namespace
}  // namespace edgescout::test
