#include "host/register/pose_classifier.h"

#include <gtest/gtest.h>

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
                 .support = {200, 60, 0.9f, 0.3f}};
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
  f.background_psi = 0.5;
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

TEST(ProbabilityOverViews, GrowsWithViewsThatAgree) {
  const PoseFeatures fair = with_psi(0.85);
  std::vector<PoseFeatures> views{fair};
  EXPECT_EQ(PoseClassifier::probability(views), PoseClassifier::probability(fair));
  views.push_back(fair);
  double last = 0;
  for (int i = 0; i < 4; ++i) {
    const double p = PoseClassifier::probability(views);
    EXPECT_GT(p, last);
    last = p;
    views.push_back(fair);
  }
  EXPECT_GT(last, 0.9);
  // A pose that no view shows stays improbable, however many views there are.
  for (const double unexplained : {0.09, 0.25, 1.0})
    for (int n = 2; n <= 40; ++n) {
      views.assign(std::size_t(n), with_psi(0.5));
      for (PoseFeatures& f : views) f.shading = {1000, 1e6, 1e6 * unexplained};
      EXPECT_LT(PoseClassifier::probability(views), 0.1) << n << " views, " << unexplained;
    }
}

// n views count as the square root of n, up to the number of views of the fit.
TEST(ProbabilityOverViews, CountsViewsAsDependentErrors) {
  const PoseFeatures fair = with_psi(0.8);
  const auto of = [&](std::size_t n) { return log_odds_of(std::vector(n, fair)); };
  const double a_view = (of(4) - of(2)) / (2 - std::sqrt(2)), bias = of(4) - 2 * a_view;
  EXPECT_LT(bias, -5);
  EXPECT_NEAR(of(3), bias + std::sqrt(3) * a_view, 1e-6);
  EXPECT_NEAR(of(5), bias + std::sqrt(5) * a_view, 1e-6);
  EXPECT_NEAR(of(20), of(5), 1e-6);
}

TEST(ProbabilityOverViews, GrowsWithPsiAndFallsWithBackgroundPsi) {
  const PoseFeatures fair = with_psi(0.8);
  PoseFeatures more = fair, striped = fair, darker = fair;
  more.psi = 0.85;
  striped.background_psi = 0.7;
  darker.shading = {1000, 1e6, 5e5};
  const double p = PoseClassifier::probability(std::vector{fair, fair});
  EXPECT_GT(PoseClassifier::probability(std::vector{fair, more}), p);
  EXPECT_LT(PoseClassifier::probability(std::vector{fair, striped}), p);
  EXPECT_LT(PoseClassifier::probability(std::vector{fair, darker}), p);
}

// A view that shows nothing of a pose counts against it by a bounded amount. The order of views
// does not matter.
TEST(ProbabilityOverViews, AHiddenViewCostsABoundedAmount) {
  const PoseFeatures good = with_psi(0.95);
  PoseFeatures hidden = with_psi(0), worse = hidden;
  hidden.psi = 0.55;
  worse.background_psi = 1;
  const double without = log_odds_of({good, good, good}),
               with = log_odds_of({good, good, good, hidden});
  EXPECT_LT(with, without);
  EXPECT_GT(PoseClassifier::probability(std::vector{good, good, good, hidden}), 0.5);
  EXPECT_NEAR(log_odds_of({good, good, good, worse}), with, 1e-9);
  EXPECT_NEAR(log_odds_of({hidden, good, good, good}), with, 1e-9);
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

}  // namespace
}  // namespace edgescout::test
