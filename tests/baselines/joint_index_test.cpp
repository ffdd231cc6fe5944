// DC-ICP's association, compared with a search over all edge points.
#include "host/baselines/joint_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/baselines/random_edges.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

double joint_distance(const EdgePoint& edge, float x_px, float y_px, float theta_rad,
                      float lambda) {
  const double turn = std::abs(double(edge.theta_rad) - theta_rad);
  return std::hypot(edge.x_px - x_px, edge.y_px - y_px) +
         lambda * std::min(turn, std::numbers::pi - turn);
}

// Sparse and dense images of odd sizes, weights from none to the paper's, places inside and far
// outside.
TEST(JointIndex, FindsTheClosestInPlaceAndDirection) {
  Random random = test_random();
  for (const int count : {1, 3, 40, 2000})
    for (const float lambda : {0.0f, 6.0f, 100.0f}) {
      const int width = 157, height = 93;
      const std::vector<EdgePoint> edges = random_edges(count, width, height, random);
      const JointIndex index(edges, width, height, lambda);
      for (int tries = 0; tries < 200; ++tries) {
        const float x = float(random.uniform(-150, 300)), y = float(random.uniform(-150, 250)),
                    theta = float(random.uniform(0, std::numbers::pi));
        double least = std::numeric_limits<double>::max();
        for (const EdgePoint& edge : edges)
          least = std::min(least, joint_distance(edge, x, y, theta, lambda));
        const EdgePoint* found = index.closest(x, y, theta);
        ASSERT_NE(found, nullptr);
        EXPECT_NEAR(joint_distance(*found, x, y, theta, lambda), least, 1e-4 * (1 + least))
            << count << " edges, lambda " << lambda;
      }
    }
}

// A pose far off projects anywhere. The search covers the image once.
TEST(JointIndex, FindsTheClosestFromFarOutsideTheImage) {
  Random random = test_random();
  const std::vector<EdgePoint> edges = random_edges(40, 157, 93, random);
  const JointIndex index(edges, 157, 93, 6);
  for (const float far_px : {1e3f, 1e5f, 1e9f, 1e12f, 1e18f})
    for (const auto& [x, y] :
         {std::pair{far_px, far_px}, {-far_px, far_px}, {50.0f, -far_px}, {far_px, 50.0f}}) {
      double least = std::numeric_limits<double>::max();
      for (const EdgePoint& edge : edges) least = std::min(least, joint_distance(edge, x, y, 1, 6));
      const EdgePoint* found = index.closest(x, y, 1);
      ASSERT_NE(found, nullptr) << x << ", " << y;
      EXPECT_NEAR(joint_distance(*found, x, y, 1, 6), least, 1e-6 * least) << x << ", " << y;
    }
}

TEST(JointIndex, FindsNothingFromNowhere) {
  const std::vector<EdgePoint> edges{{50, 50, 0.3f, 1}};
  const JointIndex index(edges, 100, 100, 30);
  const float infinite = std::numeric_limits<float>::infinity(), no_number = std::nanf("");
  EXPECT_EQ(index.closest(infinite, 50, 0), nullptr);
  EXPECT_EQ(index.closest(50, -infinite, 0), nullptr);
  EXPECT_EQ(index.closest(no_number, 50, 0), nullptr);
  EXPECT_EQ(index.closest(50, 50, no_number), nullptr);
  EXPECT_EQ(index.closest(3e38f, 50, 0), nullptr);
}

// 10 px away in the same direction, or 1 px away across it.
TEST(JointIndex, WeighsDirectionByLambda) {
  const float across = float(std::numbers::pi) / 2;
  const std::vector<EdgePoint> edges{{60, 50, 0.2f, 1}, {51, 50, 0.2f + across, 1}};
  const float even = 9 / across;
  EXPECT_EQ(JointIndex(edges, 100, 100, 0.99f * even).closest(50, 50, 0.2f)->x_px, 51);
  EXPECT_EQ(JointIndex(edges, 100, 100, 1.01f * even).closest(50, 50, 0.2f)->x_px, 60);
}

TEST(JointIndex, TakesDirectionsAsUndirected) {
  const std::vector<EdgePoint> edges{{50, 50, 0.3f, 1}, {50, 50, 3.1f, 1}};
  EXPECT_EQ(JointIndex(edges, 100, 100, 30).closest(50, 50, 0.02f)->theta_rad, 3.1f);
}

TEST(JointIndex, FindsNothingWhereNothingIs) {
  EXPECT_EQ(JointIndex({}, 100, 100, 30).closest(50, 50, 0), nullptr);
  const std::vector<EdgePoint> outside{{-1, 50, 0, 1}, {50, 100, 0, 1}};
  EXPECT_EQ(JointIndex(outside, 100, 100, 30).closest(50, 50, 0), nullptr);
}

}  // namespace
}  // namespace edgescout
