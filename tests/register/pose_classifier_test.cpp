#include "host/register/pose_classifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/test_random.h"

namespace edgescout::test {
namespace {

PoseFeatures random_features(Random& random) {
  PoseFeatures f;
  f.psi = random.uniform();
  f.mean_px = random.uniform(0, 60);
  f.matched = random.uniform();
  f.points = random.uniform(0, 300);
  f.length_px = random.uniform(0, 1000);
  f.in_image = random.uniform();
  f.shading = {1000, 1e6, random.uniform(0, 1e6)};
  f.support = {float(random.uniform(-20, 300)), float(random.uniform(-20, 100)),
               float(random.uniform()), float(random.uniform())};
  return f;
}

TEST(PoseProbability, IsInUnitRangeAndGrowsWithEveryFeature) {
  Random random = test_random();
  for (int i = 0; i < 1000; ++i) {
    const PoseFeatures f = random_features(random);
    const double p = PoseClassifier::probability(f);
    EXPECT_TRUE(p >= 0 && p <= 1) << p;
    if (p == 0) continue;  // too few points for other features to count
    PoseFeatures better = f;
    better.support.log_ratio = float(random.uniform(f.support.log_ratio, 400));
    EXPECT_GT(PoseClassifier::probability(better), p);
    better = f;
    better.support.interior_log_ratio = float(random.uniform(f.support.interior_log_ratio, 200));
    EXPECT_GT(PoseClassifier::probability(better), p);
    better = f;
    better.support.best_displaced = float(random.uniform(-1, f.support.best_displaced));
    EXPECT_GT(PoseClassifier::probability(better), p);
    better = f;
    better.mean_px = random.uniform(0, f.mean_px);
    EXPECT_GT(PoseClassifier::probability(better), p);
    better = f;
    better.psi = random.uniform(f.psi, 1);
    EXPECT_GE(PoseClassifier::probability(better), p) << "all below chance are equal";
    better = f;
    better.in_image = random.uniform(f.in_image, 1);
    EXPECT_GT(PoseClassifier::probability(better), p);
    better = f;
    better.shading.unexplained = random.uniform(0, f.shading.unexplained);
    EXPECT_GT(PoseClassifier::probability(better), p);
  }
}

TEST(PoseProbability, SeparatesTheBestFromTheWorst) {
  PoseFeatures f{.psi = 1,
                 .matched = 1,
                 .points = 200,
                 .length_px = 500,
                 .in_image = 1,
                 .visible = 200,
                 .shading = {1000, 1e6, 1e4},
                 .support = {200, 60, 0.9f, 0.3f},
                 .depth = {}};
  EXPECT_GT(PoseClassifier::probability(f), 0.9);
  f.psi = 0.75, f.mean_px = 8;
  f.support = {5, -5, 0.4f, 0.35f};
  EXPECT_LT(PoseClassifier::probability(f), 0.1);
  EXPECT_EQ(PoseClassifier::probability(PoseFeatures{}), 0);
}

TEST(PoseRank, WithoutAnImageIsByTheDistanceToEdges) {
  PoseFeatures near, far;
  near.mean_px = 2;
  far.mean_px = 9;
  EXPECT_GT(PoseClassifier::rank(near), PoseClassifier::rank(far));
}

TEST(PoseFeatures, PooledSumLogRatiosAndWeightFractions) {
  PoseFeatures a, b;
  a.points = 100, a.support = {40, 10, 0.8f, 0.2f};
  b.points = 300, b.support = {-8, 2, 0.4f, 0.4f};
  const EdgeSupport pooled = pool_over_views(std::vector{a, b}).support;
  EXPECT_FLOAT_EQ(pooled.log_ratio, 32);
  EXPECT_FLOAT_EQ(pooled.interior_log_ratio, 12);
  EXPECT_FLOAT_EQ(pooled.support, 0.5f);
}

PoseFeatures with_psi(double psi) {
  PoseFeatures f;
  f.psi = psi;
  f.mean_px = 3;
  f.matched = 0.8;
  f.points = f.visible = 200;
  f.length_px = 500;
  f.in_image = 1;
  f.shading = {1000, 1e6, 1e5};
  f.support = {60, 20, 0.8f, 0.4f};
  return f;
}

double log_odds_of(const std::vector<PoseFeatures>& views) {
  const double p = PoseClassifier::probability(views);
  return std::log(p / (1 - p));
}

// The same views again are no evidence, neither for a pose nor against it.
TEST(ProbabilityOverViews, RepeatedViewsAddNothing) {
  const PoseFeatures good = with_psi(0.95), poor = with_psi(0.6);
  EXPECT_EQ(PoseClassifier::probability(std::vector{good}), PoseClassifier::probability(good));
  for (const std::vector<PoseFeatures>& once :
       {std::vector{good, good}, {good, poor}, {poor, poor}}) {
    std::vector<PoseFeatures> views = once;
    for (int times = 2; times <= 20; ++times) {
      views.insert(views.end(), once.begin(), once.end());
      EXPECT_NEAR(log_odds_of(views), log_odds_of(once), 1e-9) << times;
    }
  }
}

TEST(ProbabilityOverViews, LiesBetweenThoseOfTheViewsAlone) {
  Random random = test_random();
  for (int i = 0; i < 200; ++i) {
    PoseFeatures a = random_features(random), b = random_features(random);
    a.points = b.points = 100, a.in_image = b.in_image = 1;
    const double mixed = PoseClassifier::probability(std::vector{a, b});
    const double twice_a = PoseClassifier::probability(std::vector{a, a}),
                 twice_b = PoseClassifier::probability(std::vector{b, b});
    EXPECT_GE(mixed, std::min(twice_a, twice_b) - 1e-12);
    EXPECT_LE(mixed, std::max(twice_a, twice_b) + 1e-12);
  }
}

// A pose that no view shows is improbable, however many views there are and whatever its grey.
TEST(ProbabilityOverViews, IsLowWhereNoViewShowsThePose) {
  for (const double unexplained : {0.09, 0.25, 1.0}) {
    PoseFeatures f = with_psi(0.5);
    f.mean_px = 12, f.support = {-5, -5, 0.3f, 0.3f};
    f.shading = {1000, 1e6, 1e6 * unexplained};
    EXPECT_LT(PoseClassifier::probability(std::vector(40, f)), 0.1) << unexplained;
  }
}

TEST(ProbabilityOverViews, GrowsWithTheFeaturesOfAnyView) {
  const PoseFeatures fair = with_psi(0.8);
  PoseFeatures more = fair, darker = fair;
  more.psi = 0.85;
  darker.shading = {1000, 1e6, 5e5};
  const double p = PoseClassifier::probability(std::vector{fair, fair});
  EXPECT_GT(PoseClassifier::probability(std::vector{fair, more}), p);
  EXPECT_LT(PoseClassifier::probability(std::vector{fair, darker}), p);
}

// A view that shows nothing of a pose counts against it by a bounded amount: something unknown may
// hide the pose there. The order of views does not matter.
TEST(ProbabilityOverViews, AHiddenViewCostsABoundedAmount) {
  const PoseFeatures good = with_psi(0.95);
  PoseFeatures hidden = with_psi(0), worse;
  hidden.psi = 0.55, hidden.mean_px = 15, hidden.support = {-20, -10, 0.2f, 0.4f};
  worse = hidden;
  worse.mean_px = 60, worse.support.log_ratio = -200;
  const double with = log_odds_of({good, good, good, hidden});
  EXPECT_LT(with, log_odds_of({good, good, good}));
  EXPECT_GT(PoseClassifier::probability(std::vector{good, good, good, hidden}), 0.5);
  EXPECT_LT(PoseClassifier::probability(std::vector{good, good, hidden}), 0.99);
  EXPECT_NEAR(log_odds_of({good, good, good, worse}), with, 1e-9);
  EXPECT_NEAR(log_odds_of({hidden, good, good, good}), with, 1e-9);
}

// A pose below the floor: measured surfaces hide it from everywhere, and the few edges left meet
// others by chance. What hides a pose from one view alone costs it little.
TEST(ProbabilityOverViews, APoseThatMeasuredSurfacesHideEverywhereIsImprobable) {
  PoseFeatures few_edges = with_psi(0.72);
  few_edges.in_image = 0.3;
  few_edges.support = {12, 8, 0.6f, 0.4f};
  few_edges.shading = {1000, 1e6, 6e5};
  PoseFeatures below = few_edges;
  below.depth = {.agreeing = 5, .hidden = 150, .missing = 50};
  const double p = PoseClassifier::probability(std::vector(3, few_edges));
  EXPECT_GT(p, 0.5);
  EXPECT_LT(PoseClassifier::probability(std::vector(3, below)), 0.3 * p);

  PoseFeatures shown = with_psi(0.95), hidden = shown;
  shown.depth = {.agreeing = 150};
  hidden.depth = {.agreeing = 20, .hidden = 130};
  EXPECT_GT(PoseClassifier::probability(std::vector{shown, shown, hidden}),
            0.97 * PoseClassifier::probability(std::vector{shown, shown, shown}));
}

TEST(ProbabilityOverViews, IgnoresViewsThatAreNotInformative) {
  const PoseFeatures fair = with_psi(0.85);
  PoseFeatures few = fair, outside = fair;
  few.points = 5;
  outside.in_image = 0.1;
  EXPECT_EQ(PoseClassifier::probability(std::vector{fair, few, fair, outside}),
            PoseClassifier::probability(std::vector{fair, fair}));
  EXPECT_EQ(PoseClassifier::probability(std::vector{few, fair}), PoseClassifier::probability(fair));
  EXPECT_EQ(PoseClassifier::probability(std::vector{few, outside}), 0);
  EXPECT_EQ(PoseClassifier::probability(std::vector<PoseFeatures>{}), 0);
}

TEST(PoseRank, OrdersAsTheProbability) {
  const PoseFeatures fair = with_psi(0.85), good = with_psi(0.95);
  EXPECT_EQ(PoseClassifier::rank(std::vector{fair}), PoseClassifier::rank(fair));
  EXPECT_NEAR(PoseClassifier::rank(std::vector{fair, good}), log_odds_of({fair, good}), 1e-9);
  PoseFeatures few = fair;
  few.points = 5;
  EXPECT_NEAR(PoseClassifier::rank(std::vector{fair, few}), log_odds_of({fair}), 1e-9);
  EXPECT_EQ(PoseClassifier::rank(std::vector{few, few}), -INFINITY);
}

TEST(Classify, StoresWhatTheFeaturesOfAllViewsSay) {
  Random random = test_random();
  PoseEstimate estimate;
  for (int i = 0; i < 100; ++i) {
    estimate.features = {random_features(random), random_features(random), with_psi(0.9)};
    classify(estimate);
    const std::vector<PoseFeatures>& views = estimate.features;
    const PoseFeatures pooled = pool_over_views(views);
    const PoseClassification& found = estimate.classification;
    EXPECT_EQ(found.pooled.psi, pooled.psi);
    EXPECT_EQ(found.rank, PoseClassifier::rank(views));
    EXPECT_EQ(found.pooled_rank, PoseClassifier::rank(pooled));
    EXPECT_EQ(found.pooled_log_odds, PoseClassifier::log_odds(pooled));
    EXPECT_EQ(found.probability, PoseClassifier::probability(views));
    EXPECT_EQ(found.psi_z_score, psi_z_score(pooled));
    EXPECT_EQ(found.unexplained_grey, unexplained_grey(pooled.shading));
    EXPECT_EQ(found.informative_views, std::ranges::count_if(views, is_informative));
    EXPECT_EQ(found.has_psi_above_chance, has_psi_above_chance(views));
  }
  estimate.features.clear();
  classify(estimate);
  EXPECT_EQ(estimate.classification.probability, 0) << "nothing is left of the features before";
}

}  // namespace
}  // namespace edgescout::test
