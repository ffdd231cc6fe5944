#include "host/model/triangle_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

Vector3d random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> at(-1, 1);
  return {at(random), at(random), at(random)};
}

// The nearest of many points of the triangle.
double sampled_distance(const Vector3d& x, const TriangleGrid::Triangle& t, int steps) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j)
      nearest =
          std::min(nearest, (x - t[0] - (i * (t[1] - t[0]) + j * (t[2] - t[0])) / steps).norm());
  return nearest;
}

TEST(DistanceToTriangle, IsThatOfTheNearestOfManyPoints) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const TriangleGrid::Triangle t{random_point(random), random_point(random),
                                   random_point(random)};
    const Vector3d x = 2 * random_point(random);
    const double sampled = sampled_distance(x, t, 100), found = distance_to_triangle(x, t);
    EXPECT_LE(found, sampled + 1e-12);
    EXPECT_GT(found, sampled - 0.03);
  }
}

TEST(DistanceToTriangle, KnowsTrianglesWithoutArea) {
  const TriangleGrid::Triangle line{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(2, 0, 0)};
  EXPECT_DOUBLE_EQ(distance_to_triangle({1.5, 3, 0}, line), 3);
  EXPECT_DOUBLE_EQ(distance_to_triangle({4, 0, 0}, line), 2);
}

TEST(TriangleGrid, FindsWhatBruteForceFinds) {
  std::mt19937 random(5);
  std::vector<TriangleGrid::Triangle> triangles;
  for (int i = 0; i < 60; ++i) {
    const Vector3d x = random_point(random);
    triangles.push_back({x, x + 0.4 * random_point(random), x + 0.4 * random_point(random)});
  }
  const TriangleGrid grid(triangles, 0.1);
  int near = 0;
  for (int round = 0; round < 3000; ++round) {
    const Vector3d x = 1.7 * random_point(random);
    for (const double distance : {0.02, 0.1}) {
      const bool expected = std::ranges::any_of(
          triangles, [&](const auto& t) { return distance_to_triangle(x, t) <= distance; });
      EXPECT_EQ(grid.is_within(x, distance), expected);
      near += expected;
    }
  }
  EXPECT_GT(near, 100);
}

}  // namespace
}  // namespace edgescout::test
