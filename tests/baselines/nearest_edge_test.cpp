// The labelled distance transform, compared with a search over all seeds.
#include "host/baselines/nearest_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/dcd_tensor.h"
#include "tests/baselines/random_edges.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

double seed_distance(const EdgePoint& edge, int x, int y) {
  return std::hypot(std::round(edge.x_px) - x, std::round(edge.y_px) - y);
}

TEST(NearestEdge, IsExactAtEveryPixel) {
  Random random = test_random();
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {7, 5}, {67, 41}})
    for (const int count : {1, 2, 30, 400}) {
      const std::vector<EdgePoint> edges = random_edges(count, width, height, random);
      const NearestEdges nearest = nearest_edges(edges, width, height);
      const ScalarImage distance = distance_image(nearest, edges, 1000);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          double least = std::numeric_limits<double>::max();
          for (const EdgePoint& edge : edges) least = std::min(least, seed_distance(edge, x, y));
          const std::size_t pixel = std::size_t(y) * width + x;
          ASSERT_NEAR(seed_distance(edges[nearest.index[pixel]], x, y), least, 1e-9)
              << x << " " << y;
          ASSERT_NEAR(distance.values[pixel], least, 1e-4) << x << " " << y;
        }
    }
}

TEST(NearestEdge, LeavesPointsOutsideTheImageOut) {
  const std::vector<EdgePoint> edges{{-3, 2, 0, 1}, {4, 20, 0, 1}};
  const NearestEdges nearest = nearest_edges(edges, 10, 10);
  EXPECT_TRUE(std::ranges::all_of(nearest.index, [](int i) { return i == -1; }));
  const ScalarImage distance = distance_image(nearest, edges, 60);
  EXPECT_TRUE(std::ranges::all_of(distance.values, [](float d) { return d == 60; }));
}

TEST(NearestEdge, KeepsTheFirstOfTwoPointsInOnePixel) {
  const std::vector<EdgePoint> edges{{4.2f, 5.1f, 0, 1}, {3.9f, 4.8f, 0, 1}};
  EXPECT_EQ(nearest_edges(edges, 10, 10).index[55], 0);
}

}  // namespace
}  // namespace edgescout
