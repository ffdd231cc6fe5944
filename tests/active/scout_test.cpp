// The loop in a small rendered cell: it ends with the right poses.
#include "host/active/scout.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/active/same_state.h"
#include "tests/active/small_cell.h"

namespace edgescout::test {
namespace {

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
      const bool taken =
          std::ranges::find(views.begin(), views.begin() + i, int(v)) != views.begin() + i;
      EXPECT_EQ(why.views[v].open, !taken) << v;
      if (!taken) {
        EXPECT_GE(why.views[why.view].value(), why.views[v].value()) << v;
      }
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
  options.known_probability = 0.2;
  options.max_searches = 1;
  options.detect = [&](std::span<const int> views, std::span<const ObjectView> images,
                       std::span<const ObjectPose> known) {
    EXPECT_EQ(images.back().camera.width, t.camera().width);
    EXPECT_EQ(images.size(), asked.size() + 1);
    EXPECT_EQ(std::vector(views.begin(), views.end() - 1), asked);
    EXPECT_EQ(known.size(), asked.empty() ? 0u : 1u);
    for (const ObjectPose& instance : known)
      EXPECT_LT(distance_between_m(instance.world_from_object, t.scene.placed[0].world_from_object),
                0.002);
    asked.push_back(views.back());
    return std::vector{near_truth};
  };
  Scout scout = t.scout(options);
  SimulatedCell cell = t.source();
  run_scout(scout, cell);
  EXPECT_EQ(asked, views_of(scout.state()));
  EXPECT_EQ(scout.state().candidates.size(), 1u) << "the same instance in every image";
  EXPECT_EQ(t.found(scout.state()), 1);
}

// A detector that finds one of two parts at a time, the second one after the first is known.
struct OneAtATime {
  SmallCell t{2};
  std::vector<std::size_t> known;  // at each search

  ScoutState run(const std::function<void(ScoutOptions&)>& with, int images = 1) {
    ScoutOptions options = SmallCell::options();
    options.max_views = images;
    options.known_probability = 0.2;
    options.detect = [&](std::span<const int>, std::span<const ObjectView>,
                         std::span<const ObjectPose> now) {
      known.push_back(now.size());
      std::vector<Detection> found;
      if (now.size() < t.scene.placed.size()) {
        found.resize(1);
        found[0].psi = 0.9;
        found[0].world_from_object = t.scene.placed[now.size()].world_from_object;
      }
      return found;
    };
    with(options);
    known.clear();
    Scout scout = t.scout(options);
    SimulatedCell cell = t.source();
    run_scout(scout, cell);
    return scout.state();
  }
};

TEST(Scout, SearchesAnImageAgainThatMadeMoreInstancesKnown) {
  OneAtATime r;
  const auto searches = [](int most) { return [=](ScoutOptions& o) { o.max_searches = most; }; };
  const ScoutState once = r.run(searches(1)), twice = r.run(searches(2));
  EXPECT_EQ(r.known, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(r.t.found(once), 1);
  EXPECT_EQ(r.t.found(twice), 2);
  EXPECT_EQ(twice.detections.size(), 2u);
  const ScoutStep &first = once.steps[0], &both = twice.steps[0];
  EXPECT_EQ(first.searches, 1);
  EXPECT_EQ(both.searches, 2);
  EXPECT_EQ(first.new_candidates, 1u);
  EXPECT_EQ(both.new_candidates, 2u);
  // `before` has the particles that both searches drew; its first part is that of the first search.
  ASSERT_GT(both.before.size(), first.before.size());
  for (std::size_t i = 0; i < first.before.size(); ++i)
    EXPECT_TRUE(same(both.before[i].world_from_object, first.before[i].world_from_object)) << i;
  std::set<std::string> names;
  for (const StageSeconds& stage : both.stages) names.insert(stage.name);
  EXPECT_EQ(names.size(), both.stages.size()) << "the times of both searches are added up";
  // The last search made nothing more known.
  r.run(searches(9));
  EXPECT_EQ(r.known, (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Scout, SearchesAnImageOnceWhereNothingBecomesKnown) {
  OneAtATime r;
  EXPECT_EQ(r.run([](ScoutOptions& o) { o.known_probability = 2; }, 2).steps[1].searches, 1);
  EXPECT_EQ(r.known, (std::vector<std::size_t>{0, 0}));
  const auto as_in_the_paper = [](ScoutOptions& o) { o.detect_in_every_image = false; };
  const ScoutState state = r.run(as_in_the_paper, 2);
  EXPECT_EQ(r.known, (std::vector<std::size_t>{0}));
  EXPECT_EQ(state.steps[0].searches, 1);
  EXPECT_EQ(state.steps[1].searches, 0);
}

TEST(Scout, FindsTheObjectWithEveryStrategy) {
  SmallCell t;
  SimulatedCell cell = t.source();
  for (const Strategy strategy : {Strategy::Disocclusion, Strategy::Random, Strategy::Fixed}) {
    ScoutOptions options = t.options();
    options.max_views = 2;
    options.next_view.strategy = strategy;
    options.next_view.sequence = {0, 5, 2, 1, 3, 4, 6, 7};
    options.detect_in_every_image = false;
    Scout scout = t.scout(options);
    run_scout(scout, cell);
    EXPECT_EQ(t.found(scout.state()), 1) << to_string(strategy);
    if (strategy == Strategy::Fixed) {
      EXPECT_EQ(views_of(scout.state()), (std::vector<int>{0, 5}));
    }
  }
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
  int other = 1;
  while (other == failed.view || other == ignored.view) ++other;
  scout.give(other, cell.acquire(other).image);
  EXPECT_EQ(seconds_of(scout.state().steps.back().decision), seconds_of(ignored));
}

TEST(Scout, CanContinueAfterCancellation) {
  SmallCell t;
  SimulatedCell cell = t.source();
  ScoutOptions options = t.options();
  options.max_views = 2;
  options.detect_in_every_image = false;
  Scout uninterrupted = t.scout(options);
  run_scout(uninterrupted, cell);
  int asked = 0, cancel_at = 1;
  options.cancelled = [&] { return ++asked == cancel_at; };
  Scout scout = t.scout(options);
  for (const std::size_t step : {0, 1}) {
    int cancellations = 0;
    cancel_at = 1;
    while (scout.state().steps.size() == step) {  // cancelled early and late in every stage
      asked = 0;
      try {
        const auto proposal = scout.propose();
        scout.give(proposal->view, cell.acquire(proposal->view).image);
      } catch (const Cancelled&) {
        ++cancellations;
        cancel_at += std::max(1, cancel_at / 2);
        EXPECT_EQ(scout.state().steps.size(), step);
        EXPECT_EQ(scout.state().particles.empty(), step == 0);
      }
    }
    EXPECT_GE(cancellations, 5) << "stages of image " << step;
  }
  EXPECT_FALSE(scout.propose());
  expect_same(uninterrupted.state(), scout.state());
}

// A candidate that got no particle, because there are too few, is not new in the next image.
TEST(Scout, CountsACandidateAsNewOnce) {
  SmallCell t{2};
  SimulatedCell cell = t.source();
  ScoutOptions options = t.options();
  options.detect_in_every_image = false;
  options.next_view.strategy = Strategy::Fixed;
  options.particles.count = 1;
  options.max_views = 2;
  options.detect = [&](std::span<const int>, std::span<const ObjectView>,
                       std::span<const ObjectPose>) {
    std::vector<Detection> found(2);
    for (std::size_t i = 0; i < 2; ++i) {
      found[i].psi = 0.9;
      found[i].world_from_object = t.scene.placed[i].world_from_object;
    }
    return found;
  };
  Scout scout = t.scout(options);
  run_scout(scout, cell);
  ASSERT_EQ(scout.state().steps.size(), 2u);
  EXPECT_EQ(scout.state().steps[0].new_candidates, 2u);
  EXPECT_GT(scout.state().steps[1].before.size(), scout.state().steps[0].after.size())
      << "the one left out before has its particle now";
  EXPECT_EQ(scout.state().steps[1].new_candidates, 0u);
}

// Roughening moves copies of particles apart. It is not part of the covariance.
TEST(Scout, DoesNotCountRougheningAsUncertainty) {
  SmallCell t;
  SimulatedCell cell = t.source();
  const auto found = [&](const Spread& roughened) {
    ScoutOptions options = t.options();
    options.max_views = 1;
    options.particles.min_effective = 1;
    options.particles.roughened = roughened;
    Scout scout = t.scout(options);
    run_scout(scout, cell);
    EXPECT_TRUE(scout.state().steps[0].resampled);
    return scout.state().detections;
  };
  const std::vector<ModeDetection> smooth = found({0, 0}), rough = found({0.05, 0.1});
  ASSERT_FALSE(smooth.empty());
  ASSERT_EQ(smooth.size(), rough.size());
  for (std::size_t i = 0; i < smooth.size(); ++i)
    EXPECT_EQ(smooth[i].detection.covariance, rough[i].detection.covariance);
}

// As in the paper one image is searched: the first one that shows anything.
TEST(Scout, SearchesUntilThereAreCandidates) {
  SmallCell t;
  ScoutOptions options = t.options();
  options.detect_in_every_image = false;
  Detection there;
  there.world_from_object = t.scene.placed[0].world_from_object;
  there.psi = 0.9;
  int asked = 0;
  options.detect = [&](std::span<const int>, std::span<const ObjectView>,
                       std::span<const ObjectPose>) {
    return ++asked == 1 ? std::vector<Detection>{} : std::vector{there};
  };
  Scout scout = t.scout(options);
  SimulatedCell cell = t.source();
  run_scout(scout, cell);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(scout.state().steps.size(), 3u);
  EXPECT_EQ(t.found(scout.state()), 1);
}

TEST(Scout, ProposesTheSameUntilANewImageOrFailure) {
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

}  // namespace
}  // namespace edgescout::test
