// BOP24's average precision against cases worked out by hand.
#include "host/eval/average_precision.h"

#include <gtest/gtest.h>

#include "tests/eval/cube.h"

namespace edgescout {
namespace {

AveragePrecision of_1(const std::vector<EvaluationImage>& images, int most_estimates = 100) {
  return average_precisions(images, CUBES, {}, most_estimates).at(1);
}

TEST(AveragePrecision, OfTheTruthIsOne) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 500), truth(2, 1000)};
  one.estimates = {estimate(1, 500, 0.5), estimate(2, 1000, 0.4), estimate(1, 0, 0.9)};
  const auto by_object = average_precisions(std::vector{one}, CUBES, {});
  ASSERT_EQ(by_object.size(), 2u);
  EXPECT_DOUBLE_EQ(by_object.at(1).ap_mssd, 1);
  EXPECT_DOUBLE_EQ(by_object.at(2).ap_mspd, 1);
  EXPECT_EQ(mean_over_objects(by_object).truths, 3);
  EXPECT_DOUBLE_EQ(mean_over_objects(by_object).ap_mssd, 1);
}

// Four truths. In the order of the scores: right, wrong, right, wrong, right. Recall 0.25 at
// precision 1, 0.5 at 2/3, 0.75 at 3/5. Of the 101 recalls 26 are up to 0.25, 25 up to 0.5, 25 up
// to 0.75, and 25 are not reached.
TEST(AveragePrecision, IsTheMeanPrecisionAt101Recalls) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 500), truth(1, 1000), truth(1, 1500)};
  one.estimates = {estimate(1, 0, 0.9), estimate(1, 200, 0.8), estimate(1, 500, 0.7),
                   estimate(1, 700, 0.6), estimate(1, 1000, 0.5)};
  const double expected = (26 * 1 + 25 * 2.0 / 3 + 25 * 3.0 / 5) / 101;
  for (double precision : of_1({one}).mssd) EXPECT_NEAR(precision, expected, 1e-12);
  for (double precision : of_1({one}).mspd) EXPECT_NEAR(precision, expected, 1e-12);
}

// A precision counts for the recalls below it too: wrong, right, right gives 2/3 everywhere.
TEST(AveragePrecision, TakesTheLargestPrecisionFromARecallOn) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 500)};
  one.estimates = {estimate(1, 200, 0.9), estimate(1, 0, 0.8), estimate(1, 500, 0.7)};
  EXPECT_NEAR(of_1({one}).ap_mssd, 2.0 / 3, 1e-12);
}

// 12 mm off, 12 % of the diameter: right from 15 % on, 8 of 10 thresholds.
TEST(AveragePrecision, IsAMeanOverThresholds) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0)};
  one.estimates = {estimate(1, 12, 1)};
  EXPECT_NEAR(of_1({one}).ap_mssd, 0.8, 1e-12);
  EXPECT_DOUBLE_EQ(of_1({one}).ap_mspd, 0);
}

// The estimate at the hidden truth is neither right nor wrong, and the truth is no miss.
TEST(AveragePrecision, IgnoresHiddenTruthsAndTheirEstimates) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 500, 0.09)};
  one.estimates = {estimate(1, 500, 0.9), estimate(1, 0, 0.8)};
  EXPECT_EQ(of_1({one}).truths, 1);
  EXPECT_DOUBLE_EQ(of_1({one}).ap_mssd, 1);
  one.estimates.pop_back();
  EXPECT_DOUBLE_EQ(of_1({one}).ap_mssd, 0);
  one.estimates.push_back(estimate(1, 501, 0.7));  // the hidden one is taken: this one is wrong
  one.estimates.push_back(estimate(1, 0, 0.6));
  EXPECT_DOUBLE_EQ(of_1({one}).ap_mssd, 0.5);
}

TEST(AveragePrecision, CountsASecondEstimateOfATruthAsWrong) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 500)};
  one.estimates = {estimate(1, 0, 0.9), estimate(1, 0.01, 0.8), estimate(1, 500, 0.7)};
  EXPECT_NEAR(of_1({one}).ap_mssd, (51 * 1 + 50 * 2.0 / 3) / 101, 1e-12);
}

// Scores are compared across images: the wrong one of the second image comes first.
TEST(AveragePrecision, SortsTheEstimatesOfAllImages) {
  EvaluationImage first = image(), second = image();
  first.truth = second.truth = {truth(1, 0)};
  first.estimates = {estimate(1, 0, 0.5)};
  second.estimates = {estimate(1, 300, 0.9), estimate(1, 0, 0.4)};
  EXPECT_NEAR(of_1({first, second}).ap_mssd, 2.0 / 3, 1e-12);
}

// As BOP's toolkit does.
TEST(AveragePrecision, LooksAtObjectsThatTheImageHolds) {
  EvaluationImage with = image(), without = image();
  with.truth = {truth(1, 0)};
  with.estimates = {estimate(1, 0, 0.5)};
  without.truth = {truth(2, 0)};
  without.estimates = {estimate(1, 0, 0.9)};
  const auto by_object = average_precisions(std::vector{with, without}, CUBES, {});
  EXPECT_DOUBLE_EQ(by_object.at(1).ap_mssd, 1);
  EXPECT_DOUBLE_EQ(by_object.at(2).ap_mssd, 0);
  EXPECT_DOUBLE_EQ(mean_over_objects(by_object).ap_mssd, 0.5);
}

TEST(AveragePrecision, LooksAtTheBestEstimatesOfAnImage) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0)};
  one.estimates = {estimate(1, 0, 0.1)};
  for (int i = 0; i < 99; ++i) one.estimates.push_back(estimate(2, 0, 0.9));
  EXPECT_DOUBLE_EQ(of_1({one}).ap_mssd, 1);
  one.estimates.push_back(estimate(2, 0, 0.9));
  EXPECT_DOUBLE_EQ(of_1({one}).ap_mssd, 0);
  EXPECT_DOUBLE_EQ(of_1({one}, 200).ap_mssd, 1);
}

TEST(AveragePrecision, IsNoneOfAnObjectThatIsHiddenEverywhere) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0, 0.05)};
  one.estimates = {estimate(1, 0, 0.9)};
  EXPECT_TRUE(average_precisions(std::vector{one}, CUBES, {}).empty());
  EXPECT_EQ(mean_over_objects({}).ap_mssd, 0);
}

}  // namespace
}  // namespace edgescout
