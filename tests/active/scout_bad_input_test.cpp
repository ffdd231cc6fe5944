// Sources that fail, images that show nothing, wrong camera poses, options out of range.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/active/small_cell.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

TEST(Scout, GoesOnPastAFailedAcquisition) {
  SmallCell t;
  SimulatedCell cell = t.source();
  std::vector<int> asked;
  CallbackSource stuck(t.camera(), t.views, [&](int view) {
    asked.push_back(view);
    if (asked.size() <= 2) throw AcquisitionError("timeout");
    return cell.acquire(view);
  });
  ScoutOptions options = t.options();
  options.max_views = 2;
  Scout scout = t.scout(options);
  run_scout(scout, stuck);
  const ScoutState& state = scout.state();
  EXPECT_EQ(state.end, ScoutEnd::ViewBudget);
  EXPECT_EQ(state.steps.size(), 2u);
  ASSERT_EQ(state.failed.size(), 2u);
  EXPECT_EQ(state.failed[0].view, 0);
  EXPECT_EQ(state.failed[0].reason, "timeout");
  EXPECT_EQ(state.failed[1].after_step, 0u);
  EXPECT_EQ(std::set<int>(asked.begin(), asked.end()).size(), 4u) << "none is asked for twice";
  EXPECT_EQ(t.found(state), 1);
}

// The result of a user's own detector is checked like other input.
TEST(Scout, RefusesDetectionsThatCannotBe) {
  SmallCell t;
  SimulatedCell cell = t.source();
  Detection found;
  found.world_from_object = t.scene.placed[0].world_from_object;
  ScoutOptions options = t.options();
  options.detect = [&](std::span<const int>, std::span<const ObjectView>,
                       std::span<const ObjectPose>) { return std::vector{found}; };
  Scout scout = t.scout(options);
  const auto refuses = [&](const char* word) {
    expect_input_error([&] { scout.give(0, cell.acquire(0).image); }, {"detected", word});
    EXPECT_TRUE(scout.state().steps.empty());
  };
  found.object = 1;
  refuses("object");
  found.object = -1;
  refuses("object");
  found.object = 0;
  found.world_from_object.translation_m.x() = std::numeric_limits<double>::quiet_NaN();
  refuses("pose");
  found.world_from_object = {};
  found.world_from_object.rotation.coeffs() *= 2;
  refuses("pose");
}

// Where the first view fails, a strategy that needs no candidates continues by its own rule.
TEST(Scout, KeepsToItsStrategyWhereTheFirstViewFails) {
  SmallCell t;
  SimulatedCell cell = t.source();
  const auto views_of = [&](Strategy strategy, std::uint64_t seed = 1) {
    std::vector<int> asked;
    CallbackSource stuck(t.camera(), t.views, [&](int view) {
      asked.push_back(view);
      if (asked.size() == 1) throw AcquisitionError("timeout");
      return cell.acquire(view);
    });
    ScoutOptions options = t.options();
    options.max_views = 1;
    options.first_view = 3;
    options.detect = [](std::span<const int>, std::span<const ObjectView>,
                        std::span<const ObjectPose>) { return std::vector<Detection>{}; };
    options.next_view.strategy = strategy;
    options.next_view.sequence = {3, 1, 4};
    options.next_view.seed = seed;
    Scout scout = t.scout(options);
    run_scout(scout, stuck);
    return asked;
  };
  EXPECT_EQ(views_of(Strategy::Fixed), (std::vector<int>{3, 1}));
  std::set<int> seconds;
  for (const std::uint64_t seed : {1, 2, 3, 4}) seconds.insert(views_of(Strategy::Random, seed)[1]);
  EXPECT_GT(seconds.size(), 1u);
  EXPECT_EQ(views_of(Strategy::Information), (std::vector<int>{3, 4}))
      << "nothing is known: the next one";
}

// A fault of a driver must not end the run.
TEST(Scout, GoesOnPastAShotThatCannotBeUsed) {
  SmallCell t;
  SimulatedCell cell = t.source();
  int shots = 0;
  CallbackSource faulty(t.camera(), t.views, [&](int view) {
    Shot shot = cell.acquire(view);
    ++shots;
    if (shots == 1) shot.image = {160, 120, std::vector<std::uint8_t>(160 * 120)};
    if (shots == 2) shot.image.pixels.resize(100);
    if (shots == 3) shot.camera_from_world.translation_m.x() = NAN;
    if (shots == 4) throw InputError("camera: no link");
    return shot;
  });
  ScoutOptions options = t.options();
  options.max_views = 1;
  Scout scout = t.scout(options);
  run_scout(scout, faulty);
  const ScoutState& state = scout.state();
  EXPECT_EQ(state.steps.size(), 1u);
  ASSERT_EQ(state.failed.size(), 4u);
  EXPECT_NE(state.failed[0].reason.find("160x120"), std::string::npos) << state.failed[0].reason;
  EXPECT_NE(state.failed[1].reason.find("100 pixels"), std::string::npos) << state.failed[1].reason;
  EXPECT_NE(state.failed[2].reason.find("camera pose"), std::string::npos)
      << state.failed[2].reason;
  EXPECT_EQ(state.failed[3].reason, "camera: no link");
}

TEST(Scout, EndsWhereNoViewCanBeHad) {
  SmallCell t;
  CallbackSource dead(t.camera(), t.views, [](int) -> Shot { throw AcquisitionError("no arm"); });
  Scout scout = t.scout();
  run_scout(scout, dead);
  EXPECT_EQ(scout.state().end, ScoutEnd::NoViewLeft);
  EXPECT_EQ(scout.state().failed.size(), t.views.size());
  EXPECT_TRUE(scout.state().detections.empty());
}

TEST(Scout, FindsNothingInBlankImages) {
  SmallCell t;
  CallbackSource blank(t.camera(), t.views, [&](int view) {
    return Shot{{320, 240, std::vector<std::uint8_t>(320 * 240, 90)}, t.views[view]};
  });
  Scout scout = t.scout();
  run_scout(scout, blank);
  EXPECT_EQ(scout.state().steps.size(), 3u);
  EXPECT_TRUE(scout.state().detections.empty());
  EXPECT_TRUE(scout.state().particles.empty());
}

TEST(Scout, FlagsACameraPoseThatDisagrees) {
  SmallCell t;
  SimulatedCell cell = t.source();
  Scout scout = t.scout();
  for (const int view : {0, 2}) scout.give(view, cell.acquire(view).image);
  for (const ExtrinsicsCheck& check : scout.state().steps.back().extrinsics_checks)
    EXPECT_FALSE(check.disagrees) << check.residual_px;
  scout.give(5, cell.acquire(5).image, Se3{so3_exp({0, 0.02, 0}), {0.004, 0, 0}} * t.views[5]);
  const std::vector<ExtrinsicsCheck>& checks = scout.state().steps.back().extrinsics_checks;
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_TRUE(checks[2].disagrees) << checks[2].residual_px;
  EXPECT_FALSE(checks[0].disagrees || checks[1].disagrees);
}

// An image with a grossly wrong camera pose makes every instance improbable. Whether it is the
// second or the third image, it is flagged and stays so.
TEST(Scout, FlagsAGrosslyWrongCameraPose) {
  SmallCell t(3);
  SimulatedCell cell = t.source();
  const std::vector<int> order{4, 6, 2, 0};
  for (const std::size_t odd : {1u, 2u}) {
    SCOPED_TRACE(odd);
    const CollectedLog log;
    Scout scout = t.scout();
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Se3& right = t.views[static_cast<std::size_t>(order[i])];
      const Se3 reported = i == odd ? right * Se3{so3_exp({0.2, 0, 0.35}), {0, 0, 0}} : right;
      scout.give(order[i], cell.acquire(order[i]).image, reported);
      const ScoutStep& step = scout.state().steps.back();
      std::printf("image %zu%s: %zu objects;", i + 1, i == odd ? " (wrong)" : "",
                  step.detections.size());
      for (const ExtrinsicsCheck& v : step.extrinsics_checks)
        std::printf(" %.2f px by %d, %d missing%s;", v.residual_px, v.objects, v.missing,
                    v.disagrees ? ", disagrees" : "");
      std::printf("\n");
      // Two images alone cannot distinguish a wrong pose from hidden objects.
      for (std::size_t v = 0; i >= 2 && v <= i; ++v)
        EXPECT_EQ(step.extrinsics_checks[v].disagrees, v == odd) << v;
    }
    EXPECT_EQ(std::ranges::count_if(log.messages,
                                    [&](const auto& message) {
                                      return message.second.find("image " +
                                                                 std::to_string(odd + 1) + " ") !=
                                             std::string::npos;
                                    }),
              1);
  }
}

TEST(Scout, RefusesWhatItCannotUse) {
  SmallCell t;
  SimulatedCell cell = t.source();
  const Image image = cell.acquire(1).image;
  Scout scout = t.scout();
  expect_input_error(
      [&] {
        scout.give(1, Image{160, 120, std::vector<std::uint8_t>(160 * 120)});
      },
      {"160x120", "320x240"});
  Se3 bent = t.views[1];
  bent.translation_m.x() = NAN;
  expect_input_error([&] { scout.give(1, image, bent); }, {"camera pose"});
  EXPECT_TRUE(scout.state().steps.empty());
  scout.give(1, image);
  expect_input_error([&] { scout.give(1, image); }, {"view", "1 again"});
  expect_input_error([&] { scout.unreachable(1, "?"); }, {"view", "1 again"});
  EXPECT_THROW(scout.give(99, image), LogicError);
  ScoutOptions options = t.options();
  options.first_view = 8;
  expect_input_error([&] { t.scout(options); }, {"first_view", "8 views"});
  options = t.options();
  options.min_entropy_nats = NAN;
  expect_input_error([&] { t.scout(options); }, {"min_entropy"});
  for (const int view : {-1, 8}) {
    options = t.options();
    options.next_view.sequence = {0, view, 3};
    expect_input_error([&] { t.scout(options); }, {"sequence", std::to_string(view), "8 views"});
  }
  const auto expect_refused = [&](const char* field, const auto& change) {
    ScoutOptions changed = t.options();
    change(changed);
    expect_input_error([&] { t.scout(changed); }, {field});
  };
  expect_refused("region_columns",
                 [](ScoutOptions& o) { o.pipeline.detect.scan.region_columns = 0; });
  expect_refused("region_rows", [](ScoutOptions& o) { o.pipeline.detect.scan.region_rows = 0; });
  expect_refused("visibility.depth_map_size",
                 [](ScoutOptions& o) { o.particles.visibility.depth_map_size_px = 4; });
  expect_refused("visibility.tolerance",
                 [](ScoutOptions& o) { o.next_view.visibility.tolerance = NAN; });
  expect_refused("visibility.tolerance",
                 [](ScoutOptions& o) { o.particles.d2co.visibility.tolerance = -1; });
  expect_refused("edge_icp.rounds", [](ScoutOptions& o) { o.particles.edge_icp.rounds.clear(); });
  expect_refused("edge_icp.radius", [](ScoutOptions& o) {
    o.pipeline.detect.refine.edge_icp.rounds[0].radius_px = 8.5f;
  });
  expect_refused("edge_claims.match",
                 [](ScoutOptions& o) { o.detections.edge_claims.match_px = 9; });
  expect_refused("edge_claims.match",
                 [](ScoutOptions& o) { o.pipeline.detect.edge_claims.match_px = NAN; });
  expect_refused("extrinsics.absent_probability",
                 [](ScoutOptions& o) { o.extrinsics.absent_probability = 0.5; });
  expect_refused("extrinsics.max_residual_px",
                 [](ScoutOptions& o) { o.extrinsics.max_residual_px = NAN; });
  expect_refused("detections.min_probability",
                 [](ScoutOptions& o) { o.detections.min_probability = -1; });
  expect_refused("min_information", [](ScoutOptions& o) {
    o.next_view.use_paper_formula = true;
    o.min_information_nats = 0.1;
  });
  expect_refused("metre_cost", [](ScoutOptions& o) {
    o.next_view.use_paper_formula = true;
    o.next_view.motion_cost_per_m = 0.1;
  });
  options = t.options();
  options.particles.count = 16385;
  expect_input_error([&] { t.scout(options); }, {"scout.particles", "16385"});
  t.views.push_back(t.views[2]);
  expect_input_error([&] { t.scout(); }, {"scout: views"});
  expect_input_error([&] { Scout({}, t.camera(), {Se3{}}, {}, *t.backend); }, {"no object"});
}

}  // namespace
}  // namespace edgescout::test
