// The loop in a small rendered cell: it ends with the right poses, whatever interrupts it; and it ends when
// it should.
#include "host/active/scout.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/active/small_cell.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

bool same(const Se3& a, const Se3& b) {
  return a.translation_m == b.translation_m && a.rotation.coeffs() == b.rotation.coeffs();
}

// Everything but the times.
void expect_same(const ScoutState& a, const ScoutState& b) {
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    EXPECT_EQ(a.steps[i].decision.view, b.steps[i].decision.view) << i;
    ASSERT_EQ(a.steps[i].decision.views.size(), b.steps[i].decision.views.size());
    for (std::size_t v = 0; v < a.steps[i].decision.views.size(); ++v)
      EXPECT_EQ(a.steps[i].decision.views[v].information, b.steps[i].decision.views[v].information);
    EXPECT_EQ(a.steps[i].image.pixels, b.steps[i].image.pixels);
    EXPECT_EQ(a.steps[i].entropy_nats, b.steps[i].entropy_nats);
  }
  ASSERT_EQ(a.particles.size(), b.particles.size());
  for (std::size_t i = 0; i < a.particles.size(); ++i) {
    EXPECT_TRUE(same(a.particles[i].world_from_object, b.particles[i].world_from_object)) << i;
    EXPECT_EQ(a.particles[i].log_weight, b.particles[i].log_weight);
  }
  ASSERT_EQ(a.detections.size(), b.detections.size());
  for (std::size_t i = 0; i < a.detections.size(); ++i) {
    EXPECT_TRUE(
        same(a.detections[i].detection.world_from_object, b.detections[i].detection.world_from_object));
    EXPECT_EQ(a.detections[i].detection.probability, b.detections[i].detection.probability);
    EXPECT_EQ(a.detections[i].supporting_views, b.detections[i].supporting_views);
  }
  EXPECT_EQ(a.failed.size(), b.failed.size());
  EXPECT_EQ(a.end, b.end);
}

std::vector<int> views_of(const ScoutState& state) {
  std::vector<int> views;
  for (const ScoutStep& step : state.steps) views.push_back(step.decision.view);
  return views;
}

TEST(Scout, EndsWithTheRightPoses) {
  SmallCell t(2);
  Scout scout = t.scout();
  SimulatedCell cell = t.source();
  std::vector<double> entropies;
  run_scout(scout, cell, [&](const ScoutState& state) { entropies.push_back(state.entropy_nats); });
  const ScoutState& state = scout.state();
  EXPECT_EQ(state.end, ScoutEnd::ViewBudget);
  ASSERT_EQ(state.steps.size(), 3u);
  EXPECT_EQ(t.found(state), 2);
  EXPECT_EQ(state.detections.size(), 2u) << "and nothing else";
  EXPECT_LT(entropies.back(), entropies.front());
  const std::vector<int> views = views_of(state);
  EXPECT_EQ(views[0], 0);
  EXPECT_EQ(std::set<int>(views.begin(), views.end()).size(), 3u);
  for (std::size_t i = 1; i < 3; ++i) {
    const ScoutDecision& why = state.steps[i].decision;
    ASSERT_EQ(why.views.size(), t.views.size());
    for (std::size_t v = 0; v < why.views.size(); ++v) {
      const bool taken = std::ranges::find(views.begin(), views.begin() + i, int(v)) != views.begin() + i;
      EXPECT_EQ(why.views[v].open, !taken) << v;
      EXPECT_GE(why.views[why.view].information, why.views[v].information) << v;
    }
    EXPECT_GT(why.views[why.view].information, 0);
    EXPECT_FALSE(why.likeliest == why.unlikeliest);
  }
}

TEST(Scout, TakesCandidatesFromADetectorOfOnesOwn) {
  SmallCell t;
  ScoutOptions options = SmallCell::options();
  std::vector<int> asked;
  Detection near_truth;
  Vector6d off;
  off << 0.002, -0.001, 0.001, 0.02, 0.03, -0.02;
  near_truth.world_from_object = retract(t.scene.placed[0].world_from_object, off);
  near_truth.psi = 0.9;
  options.detect = [&](int view, const Observation& observation, std::span<const Observation>) {
    EXPECT_EQ(observation.view.camera.width, t.camera().width);
    asked.push_back(view);
    return std::vector{near_truth};
  };
  Scout scout = t.scout(options);
  SimulatedCell cell = t.source();
  run_scout(scout, cell);
  EXPECT_EQ(asked, views_of(scout.state()));
  EXPECT_EQ(scout.state().candidates.size(), 1u) << "the same instance in every image";
  EXPECT_EQ(t.found(scout.state()), 1);
}

TEST(Scout, EveryStrategyLooksAround) {
  SmallCell t;
  SimulatedCell cell = t.source();
  for (const Strategy strategy : {Strategy::Disocclusion, Strategy::Random, Strategy::Fixed}) {
    ScoutOptions options = t.options();
    options.next_view.strategy = strategy;
    options.next_view.sequence = {0, 5, 2, 1, 3, 4, 6, 7};
    options.detect_in_every_image = false;
    Scout scout = t.scout(options);
    run_scout(scout, cell);
    EXPECT_EQ(t.found(scout.state()), 1) << to_string(strategy);
    if (strategy == Strategy::Fixed) {
      EXPECT_EQ(views_of(scout.state()), (std::vector<int>{0, 5, 2}));
    }
  }
}

// Stopped after so many images, saved, loaded and gone on with: the same to the end as without a stop.
void expect_goes_on(SmallCell& t, const ScoutOptions& options, SimulatedCell cell,
                    std::initializer_list<int> stops) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state";
  Scout whole = t.scout(options);
  run_scout(whole, cell);
  for (const int steps : stops) {
    {
      Scout killed = t.scout(options);
      for (int i = 0; i < steps; ++i) {
        const auto proposal = killed.propose();
        ASSERT_TRUE(proposal);
        const Shot shot = cell.acquire(proposal->view);
        killed.give(proposal->view, shot.image, shot.camera_from_world);
      }
      save_scout_state(killed.state(), file);
    }
    Scout resumed = t.scout(options);
    resumed.resume(load_scout_state(file), file.string());
    EXPECT_EQ(resumed.state().steps.size(), std::size_t(steps));
    run_scout(resumed, cell);
    expect_same(whole.state(), resumed.state());
  }
}

TEST(Scout, GoesOnFromASavedStateAsIfNothingHadHappened) {
  SmallCell t;
  expect_goes_on(t, SmallCell::options(), t.source({0.0005, 0.001, true, 3}), {1, 2});
}

// Parts on a heap, of which every reported one hides what is behind it: the next image's registrations depend
// on that.
TEST(Scout, GoesOnWithWhatHidesOthers) {
  SmallCell t(4, 1);
  ScoutOptions options = SmallCell::options();
  options.known_probability = 0;
  expect_goes_on(t, options, t.source(), {2});
}

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

// A driver's fault must not end the run.
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
  EXPECT_NE(state.failed[2].reason.find("camera pose"), std::string::npos) << state.failed[2].reason;
  EXPECT_EQ(state.failed[3].reason, "camera: no link");
}

TEST(Scout, CountsTheTimeOfDecisionsThatWereNotFollowed) {
  SmallCell t;
  SimulatedCell cell = t.source();
  Scout scout = t.scout();
  scout.give(0, cell.acquire(0).image);
  const auto seconds_of = [](const ScoutDecision& decision) {
    double seconds = 0;
    for (const StageSeconds& stage : decision.stages) seconds += stage.seconds;
    return seconds;
  };
  const double before = scout.state().seconds();
  const ScoutDecision failed = *scout.propose();
  scout.unreachable(failed.view, "behind the wall");
  EXPECT_GT(seconds_of(failed), 0);
  EXPECT_DOUBLE_EQ(scout.state().seconds(), before + seconds_of(failed));
  const ScoutDecision ignored = *scout.propose();
  const int other = ignored.view == 3 ? 4 : 3;
  scout.give(other, cell.acquire(other).image);
  EXPECT_EQ(seconds_of(scout.state().steps.back().decision), seconds_of(ignored));
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

TEST(Scout, CancelledItStandsWhereItStoodAndCanGoOn) {
  SmallCell t;
  SimulatedCell cell = t.source();
  ScoutOptions options = t.options();
  options.max_views = 2;
  options.detect_in_every_image = false;
  Scout undisturbed = t.scout(options);
  run_scout(undisturbed, cell);
  int asked = 0, cancel_at = 0;
  options.cancelled = [&] { return ++asked == cancel_at; };
  Scout scout = t.scout(options);
  for (const std::size_t step : {0, 1}) {
    int cancellations = 0;
    while (scout.state().steps.size() == step) {  // each stage in turn is cancelled once
      asked = 0;
      cancel_at = cancellations + 1;
      try {
        const auto proposal = scout.propose();
        scout.give(proposal->view, cell.acquire(proposal->view).image);
      } catch (const Cancelled&) {
        ++cancellations;
        EXPECT_EQ(scout.state().steps.size(), step);
        EXPECT_EQ(scout.state().particles.empty(), step == 0);
      }
    }
    EXPECT_GE(cancellations, 5) << "stages of image " << step;
  }
  EXPECT_FALSE(scout.propose());
  expect_same(undisturbed.state(), scout.state());
}

TEST(Scout, EndsByEachOfItsLimits) {
  SmallCell t;
  SimulatedCell cell = t.source();
  const auto ended = [&](const std::function<void(ScoutOptions&)>& limit) {
    ScoutOptions options = t.options();
    limit(options);
    Scout scout = t.scout(options);
    run_scout(scout, cell);
    EXPECT_FALSE(scout.propose()) << "it stays ended";
    return std::pair(scout.state().end, scout.state().steps.size());
  };
  using End = std::pair<ScoutEnd, std::size_t>;
  EXPECT_EQ(ended([](ScoutOptions& o) { o.max_views = 1; }), End(ScoutEnd::ViewBudget, 1));
  EXPECT_EQ(ended([](ScoutOptions& o) { o.min_entropy_nats = 1000; }), End(ScoutEnd::Certain, 1));
  EXPECT_EQ(ended([](ScoutOptions& o) { o.max_seconds = 1e-6; }), End(ScoutEnd::TimeSpent, 1));
  EXPECT_EQ(ended([](ScoutOptions& o) { o.min_information_nats = 1000; }), End(ScoutEnd::LittleToLearn, 1));
  EXPECT_EQ(ended([](ScoutOptions& o) { o.next_view.reachable = [](int view) { return view == 3; }; }),
            End(ScoutEnd::NoViewLeft, 1));
}

TEST(Scout, ProposesTheSameUntilThereIsNews) {
  SmallCell t;
  SimulatedCell cell = t.source();
  Scout scout = t.scout();
  ASSERT_EQ(scout.propose()->view, 0);
  ASSERT_EQ(scout.propose()->view, 0);
  scout.give(0, cell.acquire(0).image);
  const int next = scout.propose()->view;
  EXPECT_EQ(scout.propose()->view, next);
  scout.unreachable(next, "behind the wall");
  const auto other = scout.propose();
  ASSERT_TRUE(other);
  EXPECT_NE(other->view, next);
  EXPECT_FALSE(other->views[next].open);
}

TEST(Scout, WithNothingToSeeItLooksOnAndFindsNothing) {
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
  for (const ViewAgreement& agreement : scout.state().steps.back().agreement)
    EXPECT_FALSE(agreement.disagrees) << agreement.residual_px;
  scout.give(5, cell.acquire(5).image, Se3{so3_exp({0, 0.02, 0}), {0.004, 0, 0}} * t.views[5]);
  const std::vector<ViewAgreement>& agreement = scout.state().steps.back().agreement;
  ASSERT_EQ(agreement.size(), 3u);
  EXPECT_TRUE(agreement[2].disagrees) << agreement[2].residual_px;
  EXPECT_FALSE(agreement[0].disagrees || agreement[1].disagrees);
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
  expect_input_error([&] { t.scout(options); }, {"min_entropy_nats"});
  for (const int view : {-1, 8}) {
    options = t.options();
    options.next_view.sequence = {0, view, 3};
    expect_input_error([&] { t.scout(options); }, {"sequence", std::to_string(view), "8 views"});
  }
  const auto expect_refused = [&](const char* field, const auto& spoil) {
    ScoutOptions spoilt = t.options();
    spoil(spoilt);
    expect_input_error([&] { t.scout(spoilt); }, {field});
  };
  expect_refused("region_columns", [](ScoutOptions& o) { o.pipeline.detect.scan.region_columns = 0; });
  expect_refused("region_rows", [](ScoutOptions& o) { o.pipeline.detect.scan.region_rows = 0; });
  expect_refused("polish.rounds", [](ScoutOptions& o) { o.particles.polish_options.rounds.clear(); });
  expect_refused("polish.radius",
                 [](ScoutOptions& o) { o.pipeline.detect.refine.polish_options.rounds[0].radius_px = 8.5f; });
  expect_refused("evidence.match", [](ScoutOptions& o) { o.detections.evidence.match_px = 9; });
  expect_refused("evidence.match", [](ScoutOptions& o) { o.pipeline.detect.evidence.match_px = NAN; });
  expect_refused("max_residual_px", [](ScoutOptions& o) { o.agreement.max_residual_px = NAN; });
  expect_refused("detections.min_probability", [](ScoutOptions& o) { o.detections.min_probability = -1; });
  options = t.options();
  options.particles.count = 16385;
  expect_input_error([&] { t.scout(options); }, {"particles.count", "16385"});
  t.views.push_back(t.views[2]);
  expect_input_error([&] { t.scout(); }, {"scout: views"});
  expect_input_error([&] { Scout({}, t.camera(), {Se3{}}, {}, *t.backend); }, {"no object"});
}

TEST(ScoutState, OfAnotherRunOrDamagedIsRefused) {
  SmallCell t;
  const TemporaryFolder folder;
  SimulatedCell cell = t.source();
  ScoutOptions options = t.options();
  options.max_views = 1;
  Scout scout = t.scout(options);
  run_scout(scout, cell);
  const std::string file = folder.path() / "scout.state";
  save_scout_state(scout.state(), file);
  const std::string whole = content_of(file);
  for (const std::size_t length :
       {std::size_t(0), std::size_t(7), std::size_t(27), whole.size() / 2, whole.size() - 1}) {
    const std::string cut = folder.write("cut.state", whole.substr(0, length));
    expect_input_error([&] { load_scout_state(cut); }, {"cut.state"});
  }
  std::string flipped = whole;
  flipped[whole.size() / 3] ^= 4;
  const std::string bad = folder.write("bad.state", flipped);
  expect_input_error([&] { load_scout_state(bad); }, {"bad.state", "checksum"});
  SmallCell nut("hex_nut");
  Scout seeks_another = nut.scout();
  expect_input_error([&] { seeks_another.resume(load_scout_state(file), file); }, {"scout.state", "objects"});
  Scout same = t.scout();
  ScoutState wrong = scout.state();
  wrong.steps[0].after[0].object = 1;
  expect_input_error([&] { same.resume(wrong, file); }, {"scout.state", "indices"});
  wrong = scout.state();
  wrong.failed.push_back({-1, "", 0, {}});
  expect_input_error([&] { same.resume(wrong, file); }, {"scout.state", "indices"});
  t.views.pop_back();
  Scout other = t.scout();
  expect_input_error([&] { other.resume(load_scout_state(file), file); }, {"scout.state", "views"});
}

}  // namespace
}  // namespace edgescout::test
