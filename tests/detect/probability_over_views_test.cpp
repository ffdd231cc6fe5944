#include "host/detect/probability_over_views.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/detect/probability.h"

namespace edgescout::test {
namespace {

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
  return f;
}

double log_odds_of(const std::vector<PoseFeatures>& views) {
  const double p = probability_over_views(views);
  return std::log(p / (1 - p));
}

TEST(ProbabilityOverViews, GrowsWithViewsThatAgree) {
  const PoseFeatures fair = with_psi(0.85);
  std::vector<PoseFeatures> views{fair};
  EXPECT_EQ(probability_over_views(views), pose_probability(fair));
  views.push_back(fair);
  double last = 0;
  for (int i = 0; i < 4; ++i) {
    const double p = probability_over_views(views);
    EXPECT_GT(p, last);
    last = p;
    views.push_back(fair);
  }
  EXPECT_GT(last, 0.9);
  // What no view shows is not there, however many do not.
  for (const double unexplained : {0.09, 0.25, 1.0})
    for (int n = 2; n <= 40; ++n) {
      views.assign(std::size_t(n), with_psi(0.5));
      for (PoseFeatures& f : views) f.shading = {1000, 1e6, 1e6 * unexplained};
      EXPECT_LT(probability_over_views(views), 0.1) << n << " views, " << unexplained;
    }
}

// n views count for the square root of n, as far as there were so many to fit it to.
TEST(ProbabilityOverViews, CountsViewsAsErrorsThatAreNotIndependent) {
  const PoseFeatures fair = with_psi(0.8);
  const auto of = [&](std::size_t n) { return log_odds_of(std::vector(n, fair)); };
  const double a_view = (of(4) - of(2)) / (2 - std::sqrt(2)), bias = of(4) - 2 * a_view;
  EXPECT_LT(bias, -5);
  EXPECT_NEAR(of(3), bias + std::sqrt(3) * a_view, 1e-6);
  EXPECT_NEAR(of(5), bias + std::sqrt(5) * a_view, 1e-6);
  EXPECT_NEAR(of(20), of(5), 1e-6);
}

TEST(ProbabilityOverViews, GrowsWithWhatAgreesHereAndNotBeside) {
  const PoseFeatures fair = with_psi(0.8);
  PoseFeatures more = fair, striped = fair, darker = fair;
  more.psi = 0.85;
  striped.background_psi = 0.7;
  darker.shading = {1000, 1e6, 5e5};
  const double p = probability_over_views(std::vector{fair, fair});
  EXPECT_GT(probability_over_views(std::vector{fair, more}), p);
  EXPECT_LT(probability_over_views(std::vector{fair, striped}), p);
  EXPECT_LT(probability_over_views(std::vector{fair, darker}), p);
}

// The worst that one view can do is to show nothing of it; worse than nothing there is not, and the
// order of views does not matter.
TEST(ProbabilityOverViews, AHiddenViewCostsSoMuchAndNoMore) {
  const PoseFeatures good = with_psi(0.95);
  PoseFeatures hidden = with_psi(0), worse = hidden;
  hidden.psi = 0.55;
  worse.background_psi = 1;
  const double without = log_odds_of({good, good, good}),
               with = log_odds_of({good, good, good, hidden});
  EXPECT_LT(with, without);
  EXPECT_GT(probability_over_views(std::vector{good, good, good, hidden}), 0.5);
  EXPECT_NEAR(log_odds_of({good, good, good, worse}), with, 1e-9);
  EXPECT_NEAR(log_odds_of({hidden, good, good, good}), with, 1e-9);
}

TEST(ProbabilityOverViews, AViewThatDoesNotSeeItSaysNothing) {
  const PoseFeatures fair = with_psi(0.85);
  PoseFeatures few = fair, outside = fair;
  few.points = 5;
  outside.in_image = 0.1;
  EXPECT_EQ(probability_over_views(std::vector{fair, few, fair, outside}),
            probability_over_views(std::vector{fair, fair}));
  EXPECT_EQ(probability_over_views(std::vector{few, fair}), pose_probability(fair));
  EXPECT_EQ(probability_over_views(std::vector{few, outside}), 0);
  EXPECT_EQ(probability_over_views(std::vector<PoseFeatures>{}), 0);
}

TEST(Merit, RanksAsTheProbabilityDoes) {
  const PoseFeatures fair = with_psi(0.85), good = with_psi(0.95);
  EXPECT_EQ(merit(std::vector{fair}), log_odds(fair));
  EXPECT_NEAR(merit(std::vector{fair, good}), log_odds_of({fair, good}), 1e-9);
  PoseFeatures few = fair;
  few.points = 5;
  EXPECT_NEAR(merit(std::vector{fair, few}), log_odds_of({fair}), 1e-9);
  EXPECT_EQ(merit(std::vector{few, few}), -INFINITY);
}

}  // namespace
}  // namespace edgescout::test
