#include "host/eval/detection_curve.h"

#include <gtest/gtest.h>

#include <numeric>

namespace edgescout {
namespace {

// By hand: 0.9 finds A, 0.8 is false, 0.7 is A again, 0.6 finds B, 0.5 is false twice; C is never
// scored.
const std::vector<ScoredPose> poses{{0.5, -1}, {0.7, 0}, {0.9, 0}, {0.8, -1}, {0.6, 1}, {0.5, -1}};

TEST(DetectionCurve, CountsEveryThreshold) {
  const std::vector<CurvePoint> curve = detection_curve(poses, 3);
  const std::vector<std::pair<int, int>> expected{{0, 0}, {0, 1}, {1, 1}, {1, 1}, {1, 2}, {3, 2}};
  ASSERT_EQ(curve.size(), expected.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_EQ(curve[i].false_positives, expected[i].first) << i;
    EXPECT_EQ(curve[i].found, expected[i].second) << i;
    EXPECT_DOUBLE_EQ(curve[i].rate, expected[i].second / 3.0) << i;
  }
}

// No threshold parts poses of one score: the order they are listed in must not matter.
TEST(DetectionCurve, AcceptsEqualScoresAtOnce) {
  const std::vector<CurvePoint> curve = detection_curve({{1, 0}, {1, -1}, {1, 1}}, 2);
  ASSERT_EQ(curve.size(), 2u);
  EXPECT_EQ(curve[1].false_positives, 1);
  EXPECT_EQ(curve[1].found, 2);
  EXPECT_DOUBLE_EQ(rate_at(curve, 0), 0);
}

TEST(DetectionCurve, ReturnsTheRateAtANumberOfFalsePositives) {
  const std::vector<CurvePoint> curve = detection_curve(poses, 3);
  EXPECT_DOUBLE_EQ(rate_at(curve, 0), 1 / 3.0);
  EXPECT_DOUBLE_EQ(rate_at(curve, 1), 2 / 3.0);
  EXPECT_DOUBLE_EQ(rate_at(curve, 2.5), 2 / 3.0);
  EXPECT_DOUBLE_EQ(rate_at(curve, 100), 2 / 3.0);
}

TEST(DetectionCurve, OfNothingStaysAtZero) {
  const std::vector<CurvePoint> curve = detection_curve({}, 0);
  ASSERT_EQ(curve.size(), 1u);
  EXPECT_EQ(curve[0].rate, 0);
}

// Image 0 has A found at 0.9 and a false one at 0.8, image 1 B at 0.6 and C, which has no
// candidate.
const std::vector<ScoredPose> in_two_images{{0.9, 0, 0}, {0.8, -1, 0}, {0.6, 1, 1}};
const std::vector<int> instances_in_two{1, 2};

TEST(ResampledRates, AreThoseOfTheDrawnImages) {
  const Draws draws{{1, 1}, {2, 0}, {0, 2}};
  EXPECT_EQ(resampled_rates(in_two_images, instances_in_two, 0, draws),
            (std::vector<double>{1 / 3.0, 1, 0.5}));
  // Half a false positive an image is one in two: what stands at 0.6 is reached.
  EXPECT_EQ(resampled_rates(in_two_images, instances_in_two, 0.5, draws),
            (std::vector<double>{2 / 3.0, 1, 0.5}));
  EXPECT_TRUE(resampled_rates({}, {0, 0}, 1, draws).empty());
}

TEST(ResampledRates, OfEveryImageOnceAreTheCurves) {
  for (const double allowed : {0.0, 1.0, 3.0})
    EXPECT_DOUBLE_EQ(resampled_rates(poses, {3}, allowed, {{1}})[0],
                     rate_at(detection_curve(poses, 3), allowed));
}

TEST(Draws, HoldAsManyImagesAsThereAre) {
  const Draws draws = draw_images(5, 300);
  EXPECT_EQ(draws.size(), 300u);
  int first = 0;
  for (const std::vector<int>& times : draws) {
    EXPECT_EQ(std::accumulate(times.begin(), times.end(), 0), 5);
    first += times[0];
  }
  EXPECT_NEAR(first / 300.0, 1, 0.2);
}

}  // namespace
}  // namespace edgescout
