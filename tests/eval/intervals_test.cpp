#include "host/eval/intervals.h"

#include <gtest/gtest.h>

#include <vector>

#include "kernels/error.h"

namespace edgescout {
namespace {

TEST(Wilson, AgreesWithTheTextbook) {
  // 8 of 10 at z = 1.96, worked out by hand: centre (0.8 + 0.19208) / 1.38416, half width
  // sqrt(0.16 * 0.38416 + 0.0368947) / 1.38416.
  const Interval interval = wilson_interval(8, 10);
  EXPECT_NEAR(interval.low, 0.49016, 1e-5);
  EXPECT_NEAR(interval.high, 0.94332, 1e-5);
}

TEST(Wilson, StaysInsideAtTheEnds) {
  // None of 10: the upper end is z^2 / (n + z^2).
  EXPECT_EQ(wilson_interval(0, 10).low, 0);
  EXPECT_NEAR(wilson_interval(0, 10).high, 3.8416 / 13.8416, 1e-12);
  EXPECT_EQ(wilson_interval(10, 10).high, 1);
  EXPECT_NEAR(wilson_interval(10, 10).low, 10 / 13.8416, 1e-12);
}

TEST(Wilson, IsZeroToOneWithoutTrials) {
  EXPECT_EQ(wilson_interval(0, 0).low, 0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1);
}

TEST(Rate, WeighsClustersByTheirTrials) {
  const std::vector<Cluster> clusters{{1, 1}, {0, 3}};
  EXPECT_DOUBLE_EQ(rate(clusters), 0.25);
  EXPECT_EQ(rate({}), 0);
}

// Ten images without a hit do not prove a rate of 0.
TEST(Bootstrap, OfClustersThatAgreeIsWilsonsOverThem) {
  const std::vector<Cluster> none{{0, 5}, {0, 5}, {0, 2}, {0, 0}}, alike(7, {3, 4});
  EXPECT_EQ(bootstrap_interval(none).low, 0);
  EXPECT_DOUBLE_EQ(bootstrap_interval(none).high, wilson_interval(0, 3).high);
  EXPECT_DOUBLE_EQ(bootstrap_interval(alike).low, wilson_interval(0.75 * 7, 7).low);
}

TEST(Bootstrap, OfTwoClustersKnowsItsFourDraws) {
  // Rates 0, 1/2, 1/2, 1 with a quarter each: 2.5 % and 97.5 % fall on 0 and 1.
  const std::vector<Cluster> clusters{{0, 1}, {1, 1}};
  EXPECT_EQ(bootstrap_interval(clusters).low, 0);
  EXPECT_EQ(bootstrap_interval(clusters).high, 1);
}

// 40 clusters of one trial each are independent trials: the bootstrap's spread is that of the
// binomial distribution.
TEST(Bootstrap, OfIndependentTrialsIsTheBinomialSpread) {
  std::vector<Cluster> clusters;
  for (int i = 0; i < 40; ++i) clusters.push_back({i < 20 ? 1.0 : 0.0, 1});
  const Interval interval = bootstrap_interval(clusters, 4000);
  const double half = 1.96 * 0.07905694;  // sqrt(0.25 / 40)
  EXPECT_NEAR(interval.low, 0.5 - half, 0.03);
  EXPECT_NEAR(interval.high, 0.5 + half, 0.03);
}

TEST(Bootstrap, RepeatsItself) {
  const std::vector<Cluster> clusters{{0, 2}, {1, 3}, {4, 4}, {2, 5}};
  EXPECT_EQ(bootstrap_interval(clusters).low, bootstrap_interval(clusters).low);
  EXPECT_EQ(bootstrap_interval(clusters).high, bootstrap_interval(clusters).high);
}

TEST(Bootstrap, OfOneClusterIsOneTrial) {
  const std::vector<Cluster> clusters{{8, 10}};
  EXPECT_DOUBLE_EQ(bootstrap_interval(clusters).low, wilson_interval(0.8, 1).low);
  EXPECT_EQ(bootstrap_interval({}).high, 1);
}

TEST(Resampled, WithoutSpreadIsWilsons) {
  EXPECT_DOUBLE_EQ(resampled_interval({1, 1, 1}, 4).low, wilson_interval(4, 4).low);
  std::vector<double> nearly_all(1999, 1.0);  // fewer differ than an interval tells
  nearly_all.push_back(0.9);
  EXPECT_DOUBLE_EQ(resampled_interval(nearly_all, 4).low, wilson_interval(4, 4).low);
  EXPECT_EQ(resampled_interval({0, 1}, 4).low, 0);
  EXPECT_EQ(resampled_interval({}, 4).high, 1);
  EXPECT_EQ(resampled_interval({2, 2}, 4).low, 2) << "a mean number, no rate";
  EXPECT_EQ(resampled_interval({2, 2}, 4).high, 2);
}

// Clusters that are easy are so for both: their difference is better known than either.
TEST(PairedDifference, IsOverTheSameDraws) {
  const std::vector<Cluster> a{{1, 10}, {5, 10}, {9, 10}, {0, 0}},
      b{{0, 10}, {4, 10}, {8, 10}, {0, 0}};
  EXPECT_NEAR(paired_difference_interval(a, b).low, 0.1, 1e-12);
  EXPECT_NEAR(paired_difference_interval(a, b).high, 0.1, 1e-12);
  EXPECT_GT(bootstrap_interval(a).high - bootstrap_interval(a).low, 0.5);
  // Two clusters: drawn twice, once each, the other twice.
  const std::vector<Cluster> c{{3, 4}, {1, 6}}, d{{1, 4}, {3, 6}};
  EXPECT_DOUBLE_EQ(paired_difference_interval(c, d).low, -2.0 / 6);
  EXPECT_DOUBLE_EQ(paired_difference_interval(c, d).high, 2.0 / 4);
  EXPECT_EQ(paired_difference_interval(std::vector<Cluster>{}, std::vector<Cluster>{}).low, -1);
  EXPECT_THROW(paired_difference_interval(c, a), LogicError);
}

TEST(Percentiles, HoldNineteenOfTwenty) {
  std::vector<double> values;
  for (int i = 0; i <= 200; ++i) values.push_back(200 - i);
  EXPECT_EQ(percentile_interval(values).low, 5);
  EXPECT_EQ(percentile_interval(values).high, 195);
}

}  // namespace
}  // namespace edgescout
