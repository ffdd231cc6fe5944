#include "host/core/time_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace edgescout {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(TimeLimit, IsNotOverBeforeALongTime) {
  for (const double seconds : {60.0, 1e8, 1e9, 1e10, 1e300, infinity})
    EXPECT_FALSE(TimeLimit::after(seconds).is_over()) << seconds;
}

TEST(TimeLimit, IsOverAtOnceWhereNoTimeIsLeft) {
  for (const double seconds : {0.0, -1.0, -1e300, -infinity, std::nan("")})
    EXPECT_TRUE(TimeLimit::after(seconds).is_over()) << seconds;
}

TEST(TimeLimit, EndsWhenItSays) {
  const auto before = TimeLimit::Clock::now();
  const TimeLimit limit = TimeLimit::after(0.5);
  ASSERT_TRUE(limit.deadline);
  const std::chrono::duration<double> left = *limit.deadline - before;
  EXPECT_GE(left.count(), 0.5);
  EXPECT_LT(left.count(), 5);
}

}  // namespace
}  // namespace edgescout
