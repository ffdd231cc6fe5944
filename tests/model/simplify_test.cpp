// A dense mesh, its coarse copy and the depth maps of both.
#include "host/model/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host/model/triangle_grid.h"
#include "host/model/viewpoints.h"
#include "host/model/visible_edges.h"
#include "host/render/parts.h"
#include "kernels/backend.h"
#include "tests/model/solids.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;
using Corners = std::array<int, 3>;

// Divides every triangle into four.
Mesh subdivided(const Mesh& mesh, int levels) {
  std::vector<Vector3d> x = mesh.vertices_m;
  std::vector<Corners> triangles = mesh.triangles;
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), int(x.size()));
      if (fresh) x.push_back(0.5 * (x[a] + x[b]));
      return it->second;
    };
    std::vector<Corners> finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  return make_mesh(mesh.name, std::move(x), std::move(triangles));
}

TriangleGrid grid_of(const Mesh& mesh, const std::vector<Corners>& triangles, double reach_m) {
  std::vector<TriangleGrid::Triangle> list;
  for (const auto& [a, b, c] : triangles)
    list.push_back({mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]});
  return {std::move(list), reach_m};
}

// Points of the triangles, some 1 % of the diameter apart, are within the distance of the surface.
void expect_within(const Mesh& mesh, const std::vector<Corners>& triangles,
                   const TriangleGrid& surface, double distance_m) {
  for (const auto& [a, b, c] : triangles) {
    const Vector3d &origin = mesh.vertices_m[a], u = mesh.vertices_m[b] - origin,
                   v = mesh.vertices_m[c] - origin;
    const double longest_m = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int steps = std::max(1, int(longest_m / (0.01 * mesh.diameter_m)));
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j)
        ASSERT_TRUE(surface.is_within(origin + (i * u + j * v) / steps, distance_m));
  }
}

void expect_close(const Mesh& mesh, const std::vector<Corners>& coarse, double error_m) {
  expect_within(mesh, mesh.triangles, grid_of(mesh, coarse, 1.5 * error_m), 1.0001 * error_m);
  expect_within(mesh, coarse, grid_of(mesh, mesh.triangles, 1.5 * error_m), 1.0001 * error_m);
}

TEST(Simplify, KeepsBothSurfacesWithinTheBound) {
  for (const Mesh& mesh : {icosphere(0.05, 5), subdivided(make_bar(0.02, 0.1), 2),
                           subdivided(make_part("bearing_block").mesh, 2)})
    for (const double share : {1e-3, 3e-3}) {
      SCOPED_TRACE(testing::Message() << mesh.name << ", " << share);
      const std::vector<Corners> coarse = simplify(mesh, share * mesh.diameter_m);
      EXPECT_LT(5 * coarse.size(), 3 * mesh.triangles.size());
      expect_close(mesh, coarse, share * mesh.diameter_m);
    }
}

TEST(Simplify, LeavesFewTrianglesOfFlatFaces) {
  const Mesh box = subdivided(make_box({0.1, 0.1, 0.1}), 5);
  ASSERT_EQ(box.triangles.size(), 12u * 1024);
  EXPECT_LE(simplify(box, 1e-9).size(), 100u);
}

TEST(Simplify, KeepsBorders) {
  const Mesh sheet =
      subdivided(make_mesh("sheet", {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}},
                           {{0, 1, 2}, {0, 2, 3}}),
                 5);
  const std::vector<Corners> coarse = simplify(sheet, 1e-9);
  EXPECT_LE(coarse.size(), 50u);
  double area = 0;
  for (const auto& [a, b, c] : coarse)
    area += 0.5 * (sheet.vertices_m[b] - sheet.vertices_m[a])
                      .cross(sheet.vertices_m[c] - sheet.vertices_m[a])
                      .norm();
  EXPECT_NEAR(area, 0.01, 1e-9);
}

TEST(Simplify, KeepsEdgesOfThreeTriangles) {
  const Mesh fins = subdivided(
      make_mesh("fins", {{0, 0, 0}, {0, 0, 0.1}, {0.1, 0, 0}, {-0.1, 0.1, 0}, {-0.1, -0.1, 0}},
                {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}),
      4);
  expect_close(fins, simplify(fins, 1e-3), 1e-3);
}

struct DepthMaps {
  std::vector<float> fine, coarse;
};

// Of a mesh and its copy, from one place; the object fills the map.
DepthMaps depth_maps(const EdgeModel& model, const Vector3d& towards_camera, int size) {
  const std::unique_ptr<Backend> backend = make_backend("cpu");
  const Eigen::Quaterniond turn = looking_from(towards_camera);
  const double distance_m = 4 * model.mesh.diameter_m;
  const Se3 pose{turn, Vector3d(0, 0, distance_m) - turn * model.center_m};
  const float focal = float(0.9 * size * distance_m / model.mesh.diameter_m),
              middle = 0.5f * float(size - 1);
  const DepthJob job{to_pose(pose), {focal, focal, middle, middle}};
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
  for (const Vector3d& x : model.mesh.vertices_m)
    for (int i = 0; i < 3; ++i) vertices.push_back(float(x[i]));
  for (const Corners& corners : model.mesh.triangles)
    triangles.insert(triangles.end(), corners.begin(), corners.end());
  DepthMaps maps{std::vector<float>(std::size_t(size) * size), {}};
  maps.coarse = maps.fine;
  backend->depth_raster({vertices, triangles}, {&job, 1}, size, size, maps.fine);
  backend->depth_raster(model.triangle_mesh(), {&job, 1}, size, size, maps.coarse);
  return maps;
}

// Where the copy covers another pixel than the mesh, the silhouette passes within a pixel.
TEST(OccludingSurface, KeepsTheSilhouetteWithinAPixel) {
  constexpr int size = 500;
  for (const Mesh& mesh : {icosphere(0.05, 5), subdivided(make_part("l_bracket").mesh, 3),
                           subdivided(make_part("stepped_shaft").mesh, 2)}) {
    const EdgeModel model = make_edge_model(mesh);
    ASSERT_LT(model.occluding.triangles.size() / 3, mesh.triangles.size()) << mesh.name;
    for (const Vector3d& from : {Vector3d(1, 0, 0), Vector3d(0.3, -0.5, 0.8), Vector3d(-1, 2, 3)}) {
      const DepthMaps maps = depth_maps(model, from.normalized(), size);
      int others = 0;
      for (int y = 1; y + 1 < size; ++y)
        for (int x = 1; x + 1 < size; ++x) {
          const std::size_t at = std::size_t(y) * size + x;
          const bool covered = maps.fine[at] != DEPTH_EMPTY;
          if (covered == (maps.coarse[at] != DEPTH_EMPTY)) continue;
          ++others;
          bool near_silhouette = false;
          for (const int step : {-1, 1, -size, size})
            near_silhouette |= (maps.fine[at + step] != DEPTH_EMPTY) != covered;
          EXPECT_TRUE(near_silhouette) << mesh.name << " " << x << " " << y;
        }
      EXPECT_LT(others, 4 * size) << mesh.name;
    }
  }
}

TEST(OccludingSurface, ShowsAndHidesTheSameEdges) {
  const EdgeModel dense = make_edge_model(subdivided(make_part("bearing_block").mesh, 3));
  EdgeModel full = dense;
  full.occluding = {};
  for (const Vector3d& x : dense.mesh.vertices_m)
    for (int i = 0; i < 3; ++i) full.occluding.vertices_m.push_back(float(x[i]));
  for (const Corners& corners : dense.mesh.triangles)
    full.occluding.triangles.insert(full.occluding.triangles.end(), corners.begin(), corners.end());
  const std::unique_ptr<Backend> backend = make_backend("cpu");
  std::vector<Se3> poses;
  for (const Vector3d& from : edgescout::icosphere(1)) {
    const Eigen::Quaterniond turn = looking_from(from);
    poses.push_back({turn, Vector3d(0, 0, 0.5) - turn * dense.center_m});
  }
  const auto seen = visible_edges(dense, poses, *backend),
             of_full = visible_edges(full, poses, *backend);
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_NEAR(double(seen[i].size()), double(of_full[i].size()),
                0.01 * double(of_full[i].size()));
}

TEST(OccludingSurface, IsTheMeshWhereThatIsSmall) {
  const Mesh part = make_part("l_bracket").mesh;
  const OccludingSurface surface = occluding_surface(part);
  ASSERT_EQ(surface.triangles.size(), 3 * part.triangles.size());
  ASSERT_EQ(surface.vertices_m.size(), 3 * part.vertices_m.size());
  EXPECT_EQ(surface.triangles[5], std::uint32_t(part.triangles[1][2]));
  EXPECT_EQ(surface.vertices_m[4], float(part.vertices_m[1].y()));
}

}  // namespace
}  // namespace edgescout::test
