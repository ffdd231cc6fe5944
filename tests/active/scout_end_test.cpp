// When a scout ends and when it does not (host/active/scout_end.cpp).
#include <gtest/gtest.h>

#include <functional>

#include "host/active/scout.h"
#include "tests/active/same_state.h"
#include "tests/active/small_cell.h"

namespace edgescout::test {
namespace {

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
  // Certain of what was found, but not in an image that shows something new: others may follow.
  Detection there;
  there.world_from_object = t.scene.placed[0].world_from_object;
  there.psi = 0.9;
  const auto finds_the_same = [&](ScoutOptions& o) {
    o.detect = [&](std::span<const int>, std::span<const ObjectView>, std::span<const ObjectPose>) {
      return std::vector{there};
    };
  };
  const auto always_there = [&](ScoutOptions& o) {
    o.min_entropy_nats = 1000;
    finds_the_same(o);
  };
  EXPECT_EQ(ended(always_there), End(ScoutEnd::Certain, 2));
  EXPECT_EQ(ended([&](ScoutOptions& o) { always_there(o), o.detect_in_every_image = false; }),
            End(ScoutEnd::Certain, 1))
      << "no other image can show more";
  EXPECT_EQ(ended([](ScoutOptions& o) { o.max_seconds = 1e-6; }), End(ScoutEnd::TimeLimit, 1));
  EXPECT_EQ(to_string(ScoutEnd::TimeLimit), "time limit");
  EXPECT_EQ(ended([](ScoutOptions& o) { o.min_information_nats = 1000; }),
            End(ScoutEnd::LittleToLearn, 1));
  const auto exploring = [](ScoutOptions& o) {
    o.next_view.exploration_bonus_nats = 1000;
    o.min_information_nats = 100;
  };
  EXPECT_EQ(ended(exploring), End(ScoutEnd::LittleToLearn, 1))
      << "only information about candidates counts";
  const auto costly = [](ScoutOptions& o) { o.next_view.motion_cost_per_m = 1000; };
  EXPECT_EQ(ended(costly), End(ScoutEnd::ViewBudget, 3)) << "without a limit no way is too far";
  EXPECT_EQ(ended([&](ScoutOptions& o) { costly(o), o.min_information_nats = 1e-9; }),
            End(ScoutEnd::LittleToLearn, 1))
      << "what the way costs is taken off";
  // The first image's candidates are all new; the later ones find the same.
  const auto found_once = [&](ScoutOptions& o) {
    finds_the_same(o);
    o.detect_in_every_image = false;
    o.next_view.strategy = Strategy::Fixed;
  };
  EXPECT_EQ(ended([&](ScoutOptions& o) { found_once(o), o.min_gained_nats = 1000; }),
            End(ScoutEnd::LittleLearned, 2));
  EXPECT_EQ(ended([&](ScoutOptions& o) { found_once(o), o.min_gained_nats = 1e-9; }),
            End(ScoutEnd::ViewBudget, 3));
  EXPECT_EQ(
      ended([](ScoutOptions& o) { o.next_view.reachable = [](int view) { return view == 3; }; }),
      End(ScoutEnd::NoViewLeft, 1));
}

// The exploration bonus leads to a view with little information about the candidates, while another
// view has more: that is not the end.
TEST(Scout, GoesOnWhileAnyViewGivesEnough) {
  SmallCell t;
  SimulatedCell cell = t.source();
  ScoutOptions options = t.options();
  options.next_view.exploration_bonus_nats = 100;
  const auto proposed = [&] {
    Scout scout = t.scout(options);
    scout.give(0, cell.acquire(0).image);
    return scout.propose();
  };
  const auto free = proposed();
  ASSERT_TRUE(free);
  double most = 0;
  for (const ViewInformation& view : free->views)
    if (view.open) most = std::max(most, view.information);
  const double chosen = free->views[std::size_t(free->view)].information;
  ASSERT_LT(chosen, 0.99 * most);
  options.min_information_nats = 0.5 * (chosen + most);
  const auto limited = proposed();
  ASSERT_TRUE(limited);
  EXPECT_EQ(limited->view, free->view);
  options.min_information_nats = 1.01 * most;
  EXPECT_FALSE(proposed());
}

// The decision that ends a run is made once and can be read.
TEST(Scout, KeepsTheDecisionThatEndsIt) {
  SmallCell t;
  SimulatedCell cell = t.source();
  ScoutOptions options = t.options();
  options.min_information_nats = 1000;
  Scout scout = t.scout(options);
  scout.give(0, cell.acquire(0).image);
  const double before = scout.state().seconds();
  EXPECT_FALSE(scout.propose());
  EXPECT_EQ(scout.state().end, ScoutEnd::LittleToLearn);
  EXPECT_EQ(scout.state().last_decision.views.size(), t.views.size());
  const double after = scout.state().seconds();
  EXPECT_GT(after, before);
  EXPECT_FALSE(scout.propose());
  EXPECT_EQ(scout.state().seconds(), after) << "nothing was computed again";
  scout.give(1, cell.acquire(1).image);  // the user knows better
  EXPECT_TRUE(scout.state().last_decision.views.empty());
  double second = 0;
  for (const StageSeconds& stage : scout.state().steps[1].stages) second += stage.seconds;
  EXPECT_NEAR(scout.state().seconds(), after + second, 1e-9) << "the time counts all the same";
}

// All particles lose their weight at once, and again when drawn anew: nothing was gained, and
// nothing is certain.
TEST(Scout, DoesNotEndWhereAllParticlesDie) {
  SmallCell t;
  SimulatedCell cell = t.source();
  ScoutOptions options = t.options();
  options.detect_in_every_image = false;
  options.min_gained_nats = 1000;
  options.particles.dead_px = 1e-3;
  Scout scout = t.scout(options);
  run_scout(scout, cell);
  ASSERT_FALSE(scout.state().candidates.empty());
  EXPECT_TRUE(scout.state().steps.back().update.reseeded);
  EXPECT_EQ(scout.state().end, ScoutEnd::ViewBudget);
}

// No information because nothing was found is no reason to end.
TEST(Scout, GoesOnWhereTheFirstImageShowsNothing) {
  SmallCell t;
  ScoutOptions options = t.options();
  options.min_information_nats = 0.05;
  options.detect = [](std::span<const int>, std::span<const ObjectView>,
                      std::span<const ObjectPose>) { return std::vector<Detection>{}; };
  Scout scout = t.scout(options);
  SimulatedCell cell = t.source();
  run_scout(scout, cell);
  EXPECT_EQ(scout.state().end, ScoutEnd::ViewBudget);
  EXPECT_EQ(scout.state().steps.size(), 3u);
  // Without candidates the view of the largest exploration bonus is chosen, away from the first
  // one.
  const auto eye = [&](int view) {
    return inverse(t.views[static_cast<std::size_t>(view)]).translation_m;
  };
  const std::vector<int> views = views_of(scout.state());
  const std::vector<ViewInformation>& expected = scout.state().steps[1].decision.views;
  for (const ViewInformation& view : expected) {
    EXPECT_EQ(view.information, 0);
    EXPECT_LE(view.discovery, expected[static_cast<std::size_t>(views[1])].discovery);
  }
  EXPECT_GT((eye(views[1]) - eye(views[0])).norm(), 0.2);
}

}  // namespace
}  // namespace edgescout::test
