// Saving a state after every step and continuing from it.
#include "host/active/scout_state.h"

#include <gtest/gtest.h>

#include <functional>

#include "kernels/error.h"
#include "tests/active/same_state.h"
#include "tests/active/small_cell.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"
#include "tests/lens.h"

namespace edgescout::test {
namespace {

// Continues from the states saved after these numbers of images and expects the same end as without
// a stop. Returns that end.
ScoutState expect_continues(SmallCell& t, const ScoutOptions& options, ViewSource& cell,
                            std::initializer_list<std::size_t> stops) {
  const TemporaryFolder folder;
  const auto saved_after = [&](std::size_t steps) { return folder.path() / std::to_string(steps); };
  Scout whole = t.scout(options);
  run_scout(whole, cell, [&](const ScoutState& state) {
    save_scout_state(state, saved_after(state.steps.size()));
  });
  for (const std::size_t steps : stops) {
    Scout resumed = t.scout(options);
    resumed.resume(load_scout_state(saved_after(steps)), "state");
    EXPECT_EQ(resumed.state().steps.size(), steps);
    EXPECT_LT(steps, whole.state().steps.size());
    run_scout(resumed, cell);
    expect_same(whole.state(), resumed.state());
  }
  return whole.state();
}

TEST(ScoutState, ContinuesFromASavedState) {
  SmallCell t;
  SimulatedCell cell = t.source({0.0005, 0.001, true, 3});
  expect_continues(t, SmallCell::options(), cell, {1, 2});
}

// A view that failed before the first image and one after it are not proposed again.
TEST(ScoutState, ContinuesPastViewsThatFailed) {
  SmallCell t;
  SimulatedCell cell = t.source();
  const TemporaryFolder folder;
  const auto file = folder.path() / "state";
  Scout whole = t.scout(), saved = t.scout();
  for (Scout* scout : {&whole, &saved}) {
    const auto first = scout->propose();
    ASSERT_TRUE(first);
    scout->unreachable(first->view, "the arm does not get there");
    const auto second = scout->propose();
    ASSERT_TRUE(second);
    scout->give(second->view, cell.acquire(second->view).image);
    const auto third = scout->propose();
    ASSERT_TRUE(third);
    scout->unreachable(third->view, "no image in time");
  }
  save_scout_state(saved.state(), file);
  Scout resumed = t.scout();
  resumed.resume(load_scout_state(file), file.string());
  const std::vector<FailedView>&failed = resumed.state().failed, expected = saved.state().failed;
  ASSERT_EQ(failed.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(failed[i].view, expected[i].view);
    EXPECT_EQ(failed[i].reason, expected[i].reason);
    EXPECT_EQ(failed[i].after_step, i);
    ASSERT_EQ(failed[i].stages.size(), expected[i].stages.size());
  }
  EXPECT_FALSE(failed[1].stages.empty()) << "a decision was made for it";
  EXPECT_EQ(resumed.state().seconds(), saved.state().seconds());
  run_scout(whole, cell);
  run_scout(resumed, cell);
  expect_same(whole.state(), resumed.state());
  for (const int view : views_of(resumed.state()))
    for (const FailedView& f : failed) EXPECT_NE(view, f.view);
}

// Parts on a heap. Every reported one is an occluder, on which the next image's registrations
// depend.
TEST(ScoutState, ContinuesWithOccluders) {
  SmallCell t(4, 1);
  ScoutOptions options = SmallCell::options();
  options.known_probability = 0;
  SimulatedCell cell = t.source();
  expect_continues(t, options, cell, {2});
}

// The cell seen through a lens with distortion.
class BehindLens : public ViewSource {
 public:
  BehindLens(SimulatedCell cell, const Camera& camera) : cell_(std::move(cell)), camera_(camera) {}
  Camera camera() const override { return camera_; }
  std::vector<Se3> views() const override { return cell_.views(); }
  Shot acquire(int view) override {
    Shot shot = cell_.acquire(view);
    const Image ideal = shot.image;
    for (int y = 0; y < ideal.height; ++y)
      for (int x = 0; x < ideal.width; ++x) {
        const Eigen::Vector2d from = undistort_point(camera_, {x, y});
        const int left = std::clamp(int(std::floor(from.x())), 0, ideal.width - 2),
                  above = std::clamp(int(std::floor(from.y())), 0, ideal.height - 2);
        const double right = std::clamp(from.x() - left, 0.0, 1.0),
                     below = std::clamp(from.y() - above, 0.0, 1.0);
        shot.image.pixels[std::size_t(y) * std::size_t(ideal.width) + std::size_t(x)] =
            std::uint8_t(std::lround((1 - below) * ((1 - right) * ideal.at(left, above) +
                                                    right * ideal.at(left + 1, above)) +
                                     below * ((1 - right) * ideal.at(left, above + 1) +
                                              right * ideal.at(left + 1, above + 1))));
      }
    return shot;
  }

 private:
  SimulatedCell cell_;
  Camera camera_;
};

// A saved state has undistorted images; they must not be undistorted again.
TEST(ScoutState, ContinuesBehindALens) {
  SmallCell t;
  SimulatedCell straight = t.source();
  t.scene.views[0].camera.distortion = {-0.25, 0.08, 0.001, -0.002};
  BehindLens cell(std::move(straight), t.camera());
  EXPECT_EQ(t.found(expect_continues(t, SmallCell::options(), cell, {2})), 1);
}

// Everything that a log or a page reads is saved, too.
TEST(ScoutState, IsWrittenTheSameAfterItWasRead) {
  SmallCell t;
  const TemporaryFolder folder;
  SimulatedCell cell = t.source();
  ScoutOptions options = t.options();
  options.max_views = 2;
  Scout scout = t.scout(options);
  run_scout(scout, cell);
  const ScoutStep& last = scout.state().steps.back();
  EXPECT_FALSE(last.before.empty() || last.after.empty() || last.mode_probabilities.empty() ||
               last.decision.likeliest.empty() || last.extrinsics_checks.empty());
  const auto first = folder.path() / "first", second = folder.path() / "second";
  save_scout_state(scout.state(), first);
  const ScoutState loaded = load_scout_state(first);
  save_scout_state(loaded, second);
  EXPECT_EQ(content_of(first), content_of(second));
  const ScoutStep& read = loaded.steps.back();
  EXPECT_EQ(read.before.size(), last.before.size());
  EXPECT_EQ(read.after.size(), last.after.size());
  EXPECT_EQ(read.mode_probabilities, last.mode_probabilities);
  EXPECT_EQ(read.decision.likeliest, last.decision.likeliest);
  EXPECT_EQ(read.decision.unlikeliest, last.decision.unlikeliest);
  EXPECT_EQ(read.extrinsics_checks.size(), last.extrinsics_checks.size());
  EXPECT_EQ(read.searches, last.searches);
  EXPECT_EQ(read.new_candidates, last.new_candidates);
  EXPECT_EQ(read.resampled, last.resampled);
  EXPECT_EQ(loaded.camera.fx, t.camera().fx);
}

TEST(ScoutState, KeepsOverruledTimeAndTheFormula) {
  const TemporaryFolder folder;
  ScoutState state;
  state.views = {Se3{}};
  state.last_decision.use_paper_formula = true;
  state.last_decision.stages = {{"information", 2.5}};
  state.overruled_seconds = 1.25;
  save_scout_state(state, folder.path() / "state");
  ScoutState read = load_scout_state(folder.path() / "state");
  EXPECT_TRUE(read.last_decision.use_paper_formula);
  EXPECT_EQ(read.seconds(), 3.75);
  read.overrule();
  EXPECT_TRUE(read.last_decision.stages.empty());
  EXPECT_EQ(read.seconds(), 3.75);
}

// The version stands after eight bytes of magic.
TEST(ScoutState, OfAnotherVersionIsRefusedInOneLine) {
  const TemporaryFolder folder;
  save_scout_state({}, folder.path() / "state");
  const std::string current = content_of(folder.path() / "state");
  ASSERT_EQ(current[8], 18);
  for (const char version : {17, 19}) {
    std::string other = current;
    other[8] = version;
    const std::string file = folder.write("other.state", other);
    try {
      load_scout_state(file);
      ADD_FAILURE() << int(version);
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(),
                file + ": version: found " + std::to_string(int(version)) + ", expected 18");
    }
  }
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
  Scout with_other_objects = nut.scout();
  expect_input_error([&] { with_other_objects.resume(load_scout_state(file), file); },
                     {"scout.state", "objects"});
  Scout same = t.scout();
  const auto refused = [&](const std::function<void(ScoutState&)>& damage) {
    ScoutState wrong = scout.state();
    damage(wrong);
    expect_input_error([&] { same.resume(wrong, file); }, {"scout.state", "indices"});
  };
  refused([](ScoutState& s) { s.steps[0].after[0].object = 1; });
  refused([](ScoutState& s) { s.steps[0].decision.likeliest = {99}; });
  refused([](ScoutState& s) { s.steps[0].decision.unlikeliest = {-1}; });
  refused([](ScoutState& s) { s.steps[0].decision.views.resize(1); });
  refused([](ScoutState& s) { s.steps[0].decision.strategy = Strategy(7); });
  refused([](ScoutState& s) { s.last_decision.views.resize(1); });
  refused([](ScoutState& s) { s.end = ScoutEnd(77); });
  refused([](ScoutState& s) { s.failed.push_back({-1, "", 0, {}}); });
  // A new calibration: the saved images belong to another camera.
  Camera calibrated = t.camera();
  calibrated.fx *= 1.01;
  Scout with_other_camera(t.sets, calibrated, t.views, options, *t.backend);
  expect_input_error([&] { with_other_camera.resume(load_scout_state(file), file); },
                     {"scout.state", "camera"});
  t.views.pop_back();
  Scout other = t.scout();
  expect_input_error([&] { other.resume(load_scout_state(file), file); }, {"scout.state", "views"});
}

}  // namespace
}  // namespace edgescout::test
