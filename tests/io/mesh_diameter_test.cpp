#include "host/io/mesh_diameter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace edgescout {
namespace {

using Eigen::Vector3d;

double by_brute_force(const std::vector<Vector3d>& points) {
  double best = 0;
  for (const Vector3d& a : points)
    for (const Vector3d& b : points) best = std::max(best, (a - b).norm());
  return best;
}

std::vector<Vector3d> cloud(int count, const Vector3d& scale, bool on_sphere, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    Vector3d x(normal(random), normal(random), normal(random));
    if (on_sphere) x.normalize();
    points.push_back(x.cwiseProduct(scale) + Vector3d(3, -7, 11));
  }
  return points;
}

TEST(LargestDistance, AgreesWithBruteForce) {
  for (unsigned seed = 0; seed < 20; ++seed)
    for (int count : {2, 3, 17, 200})
      for (const Vector3d& scale : {Vector3d(1, 1, 1), Vector3d(1, 1e-3, 0), Vector3d(0, 0, 1e-6)})
        for (bool on_sphere : {false, true}) {
          const std::vector<Vector3d> points = cloud(count, scale, on_sphere, seed);
          EXPECT_DOUBLE_EQ(largest_distance(points), by_brute_force(points))
              << seed << " " << count;
        }
}

TEST(LargestDistance, OfFewOrEqualPointsIsZero) {
  EXPECT_EQ(largest_distance({}), 0);
  EXPECT_EQ(largest_distance({{1, 2, 3}}), 0);
  EXPECT_EQ(largest_distance({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), 0);
}

TEST(LargestDistance, OfACubeIsItsDiagonal) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? 1. : 0., i & 2 ? 1. : 0., i & 4 ? 1. : 0.});
  EXPECT_DOUBLE_EQ(largest_distance(corners), std::sqrt(3.0));
}

}  // namespace
}  // namespace edgescout
