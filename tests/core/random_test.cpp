#include "host/core/random.h"

#include <gtest/gtest.h>

#include <set>

namespace edgescout {
namespace {

// Published test vector: xoshiro256** of the state SplitMix64 makes of seed 0 starts with this
// word.
TEST(Random, FollowsItsPublishedAlgorithm) {
  Random random(0);
  EXPECT_EQ(random.bits(), 0x99ec5f36cb75f2b4u);
  EXPECT_EQ(random.bits(), 0xbf6e1f784956452au);
}

TEST(Random, StreamsDependOnSeedAndNameOnly) {
  Random drawn(7);
  const std::uint64_t before = drawn.split("noise").bits();
  drawn.bits();
  EXPECT_EQ(drawn.split("noise").bits(), before);
  std::set<std::uint64_t> different{before,
                                    Random(8).split("noise").bits(),
                                    Random(7).split("poses").bits(),
                                    Random(7).split(0).bits(),
                                    Random(7).split(1).bits(),
                                    Random(7).bits()};
  EXPECT_EQ(different.size(), 6u);
}

TEST(Random, UniformAndNormalHaveTheirMoments) {
  constexpr int DRAWS = 200000;
  Random random(1);
  double sum = 0, squares = 0, normal_sum = 0, normal_squares = 0;
  for (int i = 0; i < DRAWS; ++i) {
    const double u = random.uniform(), n = random.normal();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
    normal_sum += n;
    normal_squares += n * n;
  }
  // Five standard errors.
  EXPECT_NEAR(sum / DRAWS, 0.5, 0.0033);
  EXPECT_NEAR(squares / DRAWS, 1.0 / 3, 0.0034);
  EXPECT_NEAR(normal_sum / DRAWS, 0, 0.0112);
  EXPECT_NEAR(normal_squares / DRAWS, 1, 0.0159);
}

TEST(Random, BelowReachesEveryValueEqually) {
  Random random(2);
  int counts[7] = {};
  for (int i = 0; i < 70000; ++i) ++counts[random.below(7)];
  for (const int count : counts) EXPECT_NEAR(count, 10000, 500);
}

TEST(Random, RotationsAndDirectionsAreUniform) {
  constexpr int DRAWS = 50000;
  Random random(3);
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
  double squared_scalar = 0;
  for (int i = 0; i < DRAWS; ++i) {
    const Eigen::Vector3d d = random.direction();
    ASSERT_NEAR(d.norm(), 1, 1e-12);
    directions += d * d.transpose();
    const Eigen::Quaterniond q = random.rotation();
    ASSERT_NEAR(q.norm(), 1, 1e-12);
    rotations += q.toRotationMatrix();
    squared_scalar += q.w() * q.w();
  }
  EXPECT_LT((directions / DRAWS - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((rotations / DRAWS).cwiseAbs().maxCoeff(), 0.015);
  EXPECT_NEAR(squared_scalar / DRAWS, 0.25, 0.006);
}

}  // namespace
}  // namespace edgescout
