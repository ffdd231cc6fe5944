// Brute force over all triangles judges the tree.
#include "host/render/ray_tree.h"

#include <gtest/gtest.h>

#include "host/core/random.h"
#include "host/render/parts.h"
#include "host/render/scene_rays.h"

namespace edgescout {
namespace {

// Nearest triangle in double precision (Moeller and Trumbore).
RayHit by_brute_force(const Mesh& mesh, const Eigen::Vector3d& origin,
                      const Eigen::Vector3d& direction) {
  RayHit nearest;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [ia, ib, ic] = mesh.triangles[t];
    const Eigen::Vector3d &a = mesh.vertices_m[ia], e1 = mesh.vertices_m[ib] - a,
                          e2 = mesh.vertices_m[ic] - a;
    const Eigen::Vector3d p = direction.cross(e2), s = origin - a, q = s.cross(e1);
    const double determinant = e1.dot(p);
    if (std::abs(determinant) < 1e-18) continue;
    const double u = s.dot(p) / determinant, v = direction.dot(q) / determinant,
                 distance = e2.dot(q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && distance > 0 && distance < nearest.distance_m)
      nearest = {static_cast<int>(t), distance};
  }
  return nearest;
}

TEST(RayTree, MeetsTheTriangleThatBruteForceMeets) {
  Random random(5);
  for (const std::string& name : part_names()) {
    const Mesh mesh = make_part(name).mesh;
    const RayTree tree(mesh);
    int hits = 0, differing = 0;
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d origin = mesh.diameter_m * random.uniform(0.2, 2) * random.direction();
      const Eigen::Vector3d aim = 0.5 * mesh.diameter_m * random.uniform() * random.direction();
      const Eigen::Vector3d direction = (aim - origin).normalized();
      const RayHit expected = by_brute_force(mesh, origin, direction);
      RayHit found;
      tree.intersect(origin, direction, found);
      hits += expected.triangle >= 0;
      // Single precision may slip past an edge.
      if ((found.triangle >= 0) != (expected.triangle >= 0) ||
          (found.triangle >= 0 &&
           std::abs(found.distance_m - expected.distance_m) > 1e-5 * mesh.diameter_m))
        ++differing;
    }
    EXPECT_GT(hits, 100) << name;
    EXPECT_LE(differing, 2) << name;
  }
}

TEST(RayTree, MeetsRaysAlongTheAxes) {
  const RayTree tree(make_box({0.02, 0.04, 0.06}));
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d direction = -Eigen::Vector3d::Unit(axis);
    RayHit hit;
    tree.intersect(Eigen::Vector3d(1e-3, 2e-3, 3e-3) - 0.1 * direction, direction, hit);
    ASSERT_GE(hit.triangle, 0) << axis;
    EXPECT_NEAR(hit.distance_m, 0.1 + (axis + 1) * 1e-3 - 0.01 * (axis + 1), 1e-6) << axis;
  }
}

TEST(RayTree, KeepsANearerHit) {
  const RayTree tree(make_box({0.02, 0.02, 0.02}));
  RayHit hit;
  hit.distance_m = 0.05;
  tree.intersect({0.001, 0.002, 0.1}, {0, 0, -1}, hit);
  EXPECT_EQ(hit.triangle, -1);
  EXPECT_EQ(hit.distance_m, 0.05);
}

TEST(SceneRays, FindsTheNearestOfSeveralInstances) {
  SimulatedScene scene;
  Object cube;
  cube.mesh = make_box({0.02, 0.02, 0.02});
  scene.objects = {cube};
  for (const double x : {0.3, 0.1, 0.2})
    scene.placed.push_back({0, {so3_exp({0.3, 0.2, 0.1}), {x, 0, 0.05}}, {}});
  const SceneRays rays(scene);
  const SceneHit hit = rays.first_hit({-0.1, 0.001, 0.05}, {1, 0, 0}, 10);
  EXPECT_EQ(hit.placed, 1);
  EXPECT_NEAR(hit.hit.distance_m, 0.19, 0.003);
  EXPECT_EQ(rays.first_hit({-0.1, 0.001, 0.05}, {1, 0, 0}, 0.15).placed, -1) << "too far";
  EXPECT_EQ(rays.first_hit({-0.1, 0.001, 0.05}, {-1, 0, 0}, 10).placed, -1) << "behind";
  EXPECT_EQ(rays.first_hit({-0.1, 0.05, 0.05}, {1, 0, 0}, 10).placed, -1) << "beside";
}

}  // namespace
}  // namespace edgescout
