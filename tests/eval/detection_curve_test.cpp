#include "host/eval/detection_curve.h"

#include <gtest/gtest.h>

namespace edgescout {
namespace {

// By hand: 0.9 finds A, 0.8 is false, 0.7 is A again, 0.6 finds B, 0.5 is false twice; C is never scored.
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
TEST(DetectionCurve, AcceptsEqualScoresTogether) {
  const std::vector<CurvePoint> curve = detection_curve({{1, 0}, {1, -1}, {1, 1}}, 2);
  ASSERT_EQ(curve.size(), 2u);
  EXPECT_EQ(curve[1].false_positives, 1);
  EXPECT_EQ(curve[1].found, 2);
  EXPECT_DOUBLE_EQ(rate_at(curve, 0), 0);
}

TEST(DetectionCurve, TellsTheRateAtANumberOfFalsePositives) {
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

}  // namespace
}  // namespace edgescout
