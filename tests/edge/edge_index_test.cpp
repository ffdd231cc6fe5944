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

TEST(EdgeIndex, FindsTheNearestOfSimilarDirection) {
  Random random = test_random();
  const std::vector<EdgePoint> edges = random_points(500, random);
  const EdgeIndex index(edges, 100, 60);
  constexpr float radius_px = 7, max_turn_rad = 0.5f, pi = std::numbers::pi_v<float>;
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
    const EdgePoint* nearest = index.nearest(x, y, theta, radius_px, max_turn_rad);
    ASSERT_EQ(nearest != nullptr, best < radius_px);
    if (nearest) {
      EXPECT_NEAR(std::hypot(nearest->x_px - x, nearest->y_px - y), best, 1e-4);
    }
    found += nearest != nullptr;
  }
  EXPECT_GT(found, 200);
  EXPECT_LT(found, 500);
}

}  // namespace
}  // namespace edgescout::test
