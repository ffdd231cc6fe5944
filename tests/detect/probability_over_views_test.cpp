#include "host/detect/probability_over_views.h"

#include <gtest/gtest.h>

#include "host/detect/probability.h"

namespace edgescout::test {
namespace {

PoseFeatures with_psi(double psi) {
  PoseFeatures f;
  f.psi = psi;
  f.mean_px = 3;
  f.matched = 0.8;
  f.points = f.visible = 200;
  f.length_px = 500;
  f.in_image = 1;
  f.shading = {1000, 1e6, 4e4};
  return f;
}

// Of a psi that makes one view's probability what is asked for.
PoseFeatures with_probability(double p) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i)
    (pose_probability(with_psi(0.5 * (low + high))) < p ? low : high) = 0.5 * (low + high);
  return with_psi(0.5 * (low + high));
}

TEST(ProbabilityOverViews, GrowsWithViewsThatAgree) {
  const PoseFeatures fair = with_probability(0.15);
  const double one = pose_probability(fair);
  ASSERT_NEAR(one, 0.15, 1e-6);
  std::vector<PoseFeatures> views{fair};
  EXPECT_EQ(probability_over_views(views), one);
  double last = 0;
  for (int i = 0; i < 4; ++i) {
    const double p = probability_over_views(views);
    EXPECT_GT(p, last);
    last = p;
    views.push_back(fair);
  }
  EXPECT_GT(last, 0.9);
  // And falls with those that show nothing of it.
  views.assign(4, with_probability(0.002));
  EXPECT_LT(probability_over_views(views), 1e-3);
}

// Odds multiply, so the order of views does not matter, and the worst that one view can do is to say that it
// was hidden.
TEST(ProbabilityOverViews, AHiddenViewCostsSoMuchAndNoMore) {
  const auto odds = [](const std::vector<PoseFeatures>& views) {
    const double p = probability_over_views(views);
    return p / (1 - p);
  };
  const PoseFeatures fair = with_probability(0.3);
  PoseFeatures hidden = with_psi(0);
  hidden.mean_px = 100;
  EXPECT_NEAR(odds({fair, fair, hidden}) / odds({fair, fair}), 0.2, 0.01);
  EXPECT_NEAR(odds({hidden, fair, fair}), odds({fair, fair, hidden}), 1e-9);
}

TEST(ProbabilityOverViews, AViewThatDoesNotSeeItSaysNothing) {
  const PoseFeatures fair = with_probability(0.3);
  PoseFeatures few = fair, outside = fair;
  few.points = 5;
  outside.in_image = 0.1;
  EXPECT_EQ(probability_over_views(std::vector{fair, few, fair, outside}),
            probability_over_views(std::vector{fair, fair}));
  EXPECT_EQ(probability_over_views(std::vector{few, fair}), pose_probability(fair));
  EXPECT_EQ(probability_over_views(std::vector{few, outside}), 0);
  EXPECT_EQ(probability_over_views(std::vector<PoseFeatures>{}), 0);
}

}  // namespace
}  // namespace edgescout::test
