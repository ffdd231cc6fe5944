#include "host/eval/matching.h"

#include <gtest/gtest.h>

#include <cmath>

namespace edgescout::test {
namespace {

using Matched = std::vector<int>;

TEST(Matching, EveryEstimateTakesTheNearestFreeTruth) {
  EXPECT_EQ(match_in_order(std::vector<double>{2, 1, 3,  //
                                               2, 1, 3,  //
                                               2, 1, 3},
                           3, 10),
            (Matched{1, 0, 2}));
}

TEST(Matching, TheFirstEstimateChoosesEvenIfAnotherFitsBetter) {
  EXPECT_EQ(match_in_order(std::vector<double>{0.9, INFINITY, 0.1, 5}, 2, 1),
            (Matched{0, UNMATCHED}));
}

TEST(Matching, AnErrorAtTheThresholdIsTooLarge) {
  EXPECT_EQ(match_in_order(std::vector<double>{1, std::nextafter(1, 0)}, 1, 1),
            (Matched{UNMATCHED, 0}));
}

TEST(Matching, NothingMatchesWhatIsInfiniteOrNoNumber) {
  EXPECT_EQ(match_in_order(std::vector<double>{INFINITY, NAN}, 2, 1), Matched{UNMATCHED});
}

TEST(Matching, OfEqualErrorsTheFirstTruth) {
  EXPECT_EQ(match_in_order(std::vector<double>{0.5, 0.5}, 2, 1), Matched{0});
}

}  // namespace
}  // namespace edgescout::test
