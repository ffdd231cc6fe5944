#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "host/io/raw_mesh.h"

namespace edgescout {
namespace {

using Eigen::Vector3d;

Vector3d area_vector(const std::vector<std::array<int, 3>>& triangles,
                     const std::vector<Vector3d>& x) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& [a, b, c] : triangles) sum += 0.5 * (x[b] - x[a]).cross(x[c] - x[a]);
  return sum;
}

double area(const std::vector<std::array<int, 3>>& triangles, const std::vector<Vector3d>& x) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += 0.5 * (x[b] - x[a]).cross(x[c] - x[a]).norm();
  return sum;
}

double shoelace(const std::vector<Eigen::Vector2d>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[(i + 1) % p.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// Star-shaped and concave, in a random plane: the triangles cover it exactly once and keep its
// sense.
TEST(Triangulate, CoversAConcavePolygonExactlyOnce) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> radius(0.1, 1);
    const int corners = 4 + static_cast<int>(seed % 30);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(radius(random), radius(random), -radius(random), radius(random))
            .normalized();
    std::vector<Eigen::Vector2d> flat;
    std::vector<Vector3d> x;
    std::vector<int> indices;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      flat.push_back(radius(random) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      x.push_back(turn * Vector3d(flat.back().x(), flat.back().y(), 0) + Vector3d(5, 6, 7));
      indices.push_back(i);
    }
    std::vector<std::array<int, 3>> triangles;
    triangulate(indices, x, triangles);
    EXPECT_EQ(triangles.size(), static_cast<std::size_t>(corners - 2));
    EXPECT_NEAR(area(triangles, x), shoelace(flat), 1e-12) << seed;
    EXPECT_LT((area_vector(triangles, x) - shoelace(flat) * (turn * Vector3d::UnitZ())).norm(),
              1e-12)
        << seed;
  }
}

TEST(Triangulate, FewerThanThreeCornersMakeNothing) {
  std::vector<std::array<int, 3>> triangles;
  triangulate({}, {}, triangles);
  triangulate({0, 1}, {{0, 0, 0}, {1, 0, 0}}, triangles);
  EXPECT_TRUE(triangles.empty());
}

TEST(Triangulate, EndsOnPolygonsThatCrossThemselvesOrHaveNoArea) {
  std::vector<std::array<int, 3>> triangles;
  triangulate({0, 1, 2, 3}, {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, triangles);
  triangulate({0, 1, 2, 3}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, triangles);
  triangulate({0, 0, 0, 0}, {{0, 0, 0}}, triangles);
  EXPECT_EQ(triangles.size(), 6u);
}

}  // namespace
}  // namespace edgescout
