// Edge points by place, compared with a search over all of them, and their order.
#include "host/edge/edge_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/test_random.h"

namespace edgescout::test {
namespace {

std::vector<EdgePoint> random_points(int count, Random& random) {
  std::vector<EdgePoint> edges;
  for (int i = 0; i < count; ++i)
    edges.push_back({float(random.uniform(0, 99)), float(random.uniform(0, 59)),
                     float(random.uniform(0, std::numbers::pi)), float(i)});
  return edges;
}

TEST(EdgeIndex, KeepsTheOrderGiven) {
  Random random = test_random();
  const std::vector<EdgePoint> edges = random_points(500, random);
  const EdgeIndex index(edges, 100, 60);
  ASSERT_EQ(index.points().size(), edges.size());
  ASSERT_EQ(index.points_by_cell().size(), edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
    EXPECT_EQ(index.points()[i].strength, edges[i].strength);
  EXPECT_FALSE(std::ranges::is_sorted(index.points_by_cell(), {}, &EdgePoint::strength));
}

class EdgeIndexWithin : public testing::TestWithParam<float> {};

TEST_P(EdgeIndexWithin, FindsTheNearestOfSimilarDirection) {
  Random random = test_random();
  const std::vector<EdgePoint> edges = random_points(500, random);
  const EdgeIndex index(edges, 100, 60);
  constexpr float radius_px = 7, pi = std::numbers::pi_v<float>;
  const float max_turn_rad = GetParam();
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const float x = float(random.uniform(-5, 105)), y = float(random.uniform(-5, 65)),
                theta = float(random.uniform(0, pi));
    float best = radius_px;
    for (const EdgePoint& edge : edges) {
      const float turn = std::fabs(edge.theta_rad - theta);
      if (std::min(turn, pi - turn) < max_turn_rad)
        best = std::min(best, std::hypot(edge.x_px - x, edge.y_px - y));
    }
    const Eigen::Vector2f direction = 3 * Eigen::Vector2f(std::cos(theta), std::sin(theta));
    const EdgePoint* nearest = index.nearest({x, y}, direction, {radius_px, max_turn_rad});
    ASSERT_EQ(nearest != nullptr, best < radius_px);
    if (nearest) {
      EXPECT_NEAR(std::hypot(nearest->x_px - x, nearest->y_px - y), best, 1e-4);
      const Eigen::Vector2f normal = index.normal_of(*nearest);
      EXPECT_NEAR(
          normal.dot(Eigen::Vector2f(std::cos(nearest->theta_rad), std::sin(nearest->theta_rad))),
          0, 1e-6);
      EXPECT_NEAR(normal.norm(), 1, 1e-6);
    }
    found += nearest != nullptr;
  }
  EXPECT_GT(found, 200);
  EXPECT_LT(found, 500);
}

// From a quarter turn on every direction fits.
INSTANTIATE_TEST_SUITE_P(Turns, EdgeIndexWithin, testing::Values(0.5f, 1.2f, 1.6f, 4.0f));

}  // namespace
}  // namespace edgescout::test
