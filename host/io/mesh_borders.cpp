// Joins open borders that face each other.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "host/io/mesh_edges.h"
#include "host/io/mesh_repair.h"
#include "host/io/point_grid.h"

namespace edgescout {

using Eigen::Vector3d;

namespace {

constexpr double gap_ratio = 4;  // between the gaps that one round and the next one close
// Of a triangle's height: a corner or a side that moves less turns the normal by 14 degrees at
// most.
constexpr double largest_move = 0.25;
// A vertex divides a border edge if it is this many gaps from its ends. A nearer one is left to the
// next round, which may merge it with the end. The last round leaves none.
constexpr double gaps_from_ends = 3;

struct Border {
  std::vector<HalfEdge> edges;  // those of one triangle
  std::vector<int> vertices;    // their ends, ascending
};

Border border_of(const RawMesh& mesh) {
  Border border;
  const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
  for_each_edge(sides, [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 1) return;
    border.edges.push_back(edge[0]);
    border.vertices.insert(border.vertices.end(), {edge[0].low, edge[0].high});
  });
  std::ranges::sort(border.vertices);
  border.vertices.erase(std::unique(border.vertices.begin(), border.vertices.end()),
                        border.vertices.end());
  return border;
}

PointGrid grid_over(const RawMesh& mesh, double cell) {
  Vector3d origin = mesh.vertices.front();
  for (const Vector3d& x : mesh.vertices) origin = origin.cwiseMin(x);
  return {origin, cell};
}

// A triangle no higher than the gap is not surface but what fills the gap.
void drop_slivers_at_border(RawMesh& mesh, double gap_m) {
  std::vector<bool> at_border(mesh.triangles.size());
  for (const HalfEdge& edge : border_of(mesh).edges) at_border[edge.triangle] = true;
  std::vector<std::array<int, 3>> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!at_border[t] || smallest_height(mesh, mesh.triangles[t]) > gap_m)
      kept.push_back(mesh.triangles[t]);
  mesh.triangles = std::move(kept);
}

std::vector<double> largest_moves_m(const RawMesh& mesh) {
  std::vector<double> moves(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  for (const auto& triangle : mesh.triangles) {
    const double move = largest_move * smallest_height(mesh, triangle);
    for (const int v : triangle) moves[v] = std::min(moves[v], move);
  }
  return moves;
}

// For each border vertex the first of those that it is merged with; for the others themselves.
std::vector<int> border_groups(const RawMesh& mesh, double gap_m) {
  const std::vector<double> moves_m = largest_moves_m(mesh);
  PointGrid firsts = grid_over(mesh, 16 * gap_m);
  std::vector<int> group(mesh.vertices.size());
  std::iota(group.begin(), group.end(), 0);
  for (const int v : border_of(mesh).vertices) {
    const Vector3d& x = mesh.vertices[v];
    double nearest_m = std::numeric_limits<double>::infinity();
    firsts.for_each_near(x, std::min(gap_m, moves_m[v]), [&](int first) {
      const double distance_m = (mesh.vertices[first] - x).norm();
      if (distance_m > moves_m[first] || distance_m >= nearest_m) return;
      nearest_m = distance_m;
      group[v] = first;
    });
    if (group[v] == v) firsts.add(x, v);
  }
  return group;
}

// Puts each group of border vertices at its mean.
void merge_border_vertices(RawMesh& mesh, double gap_m) {
  const std::vector<int> group = border_groups(mesh, gap_m);
  std::vector<Vector3d> sum(mesh.vertices.size(), Vector3d::Zero());
  std::vector<int> members(mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < group.size(); ++v) {
    sum[group[v]] += mesh.vertices[v];
    ++members[group[v]];
  }
  for (std::size_t v = 0; v < group.size(); ++v)
    if (members[v] > 1) mesh.vertices[v] = sum[v] / members[v];
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = group[v];
}

struct Reach {
  double gap_m;   // from a border edge to a vertex that divides it, at most
  double ends_m;  // from the edge's ends, more than this
  double cell_m;  // of the grid of vertices; at least four gaps
};

// The border vertices on a side of a triangle, in the direction of its winding.
std::vector<int> vertices_on(const RawMesh& mesh, const HalfEdge& edge, const PointGrid& vertices,
                             const Reach& reach) {
  const auto& corners = mesh.triangles[edge.triangle];
  const Vector3d &from = mesh.vertices[corners[edge.side]],
                 &to = mesh.vertices[corners[(edge.side + 1) % 3]],
                 &opposite = mesh.vertices[corners[(edge.side + 2) % 3]];
  const double length_m = (to - from).norm();
  const Vector3d along = (to - from) / length_m;
  const double height_m = along.cross(opposite - from).norm();
  std::map<double, int> found;  // by the distance from the side's start
  const int steps = static_cast<int>(std::ceil(length_m / reach.cell_m));
  for (int i = 0; length_m > 2 * reach.ends_m && i < steps; ++i) {
    const Vector3d place = from + (i + 0.5) / steps * length_m * along;
    vertices.for_each_near(place, 0.5 * reach.cell_m + reach.gap_m, [&](int v) {
      const Vector3d x = mesh.vertices[v] - from;
      const double at_m = x.dot(along), off_m = (x - at_m * along).norm();
      if (at_m > reach.ends_m && at_m < length_m - reach.ends_m &&
          off_m <= std::min(reach.gap_m, largest_move * height_m))
        found.emplace(at_m, v);
    });
  }
  std::vector<int> on;
  for (const auto& [at_m, v] : found) on.push_back(v);
  return on;
}

// Divides a triangle so that the vertices on its sides become corners.
void divide(const std::array<int, 3>& corners, const std::array<std::vector<int>, 3>& on_sides,
            std::vector<std::array<int, 3>>& triangles) {
  for (std::size_t side = 0; side < 3; ++side) {
    const std::vector<int>& on = on_sides[side];
    if (on.empty()) continue;
    const auto middle = on.begin() + std::ptrdiff_t(on.size() / 2);
    const std::size_t next = (side + 1) % 3, last = (side + 2) % 3;
    divide({corners[side], *middle, corners[last]},
           {std::vector<int>(on.begin(), middle), {}, on_sides[last]}, triangles);
    divide({*middle, corners[next], corners[last]},
           {std::vector<int>(middle + 1, on.end()), on_sides[next], {}}, triangles);
    return;
  }
  triangles.push_back(corners);
}

void divide_border_edges(RawMesh& mesh, const Reach& reach) {
  const Border border = border_of(mesh);
  PointGrid vertices = grid_over(mesh, reach.cell_m);
  for (const int v : border.vertices) vertices.add(mesh.vertices[v], v);
  std::map<int, std::array<std::vector<int>, 3>> on_sides;  // by triangle
  for (const HalfEdge& edge : border.edges)
    if (std::vector<int> on = vertices_on(mesh, edge, vertices, reach); !on.empty())
      on_sides[edge.triangle][edge.side] = std::move(on);
  std::vector<std::array<int, 3>> divided;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto found = on_sides.find(static_cast<int>(t));
    if (found == on_sides.end())
      divided.push_back(mesh.triangles[t]);
    else
      divide(mesh.triangles[t], found->second, divided);
  }
  mesh.triangles = std::move(divided);
}

}  // namespace

void join_borders(RawMesh& mesh, double finest_m, double coarsest_m) {
  double gap_m = finest_m;
  for (bool is_last = false; !is_last && !border_of(mesh).edges.empty(); gap_m *= gap_ratio) {
    is_last = gap_ratio * gap_m > coarsest_m;
    drop_slivers_at_border(mesh, gap_m);
    merge_border_vertices(mesh, gap_m);
    drop_slivers_and_duplicates(mesh, finest_m);
    divide_border_edges(mesh, {gap_m, (is_last ? 1 : gaps_from_ends) * gap_m, 4 * coarsest_m});
  }
}

}  // namespace edgescout
