// Makes the winding of neighbouring triangles agree.
#include <Eigen/Geometry>
#include <utility>

#include "host/io/mesh_edges.h"
#include "host/io/mesh_repair.h"

namespace edgescout {

using Eigen::Vector3d;

namespace {

struct Neighbour {
  int triangle = -1;  // none: the edge has one triangle, or more than two
  bool agrees = true;
};

struct Neighbours {
  std::vector<std::array<Neighbour, 3>> of_triangle;
  std::vector<bool> has_border;  // a side that no other triangle shares
};

Neighbours neighbours_of(const RawMesh& mesh) {
  Neighbours result{std::vector<std::array<Neighbour, 3>>(mesh.triangles.size()),
                    std::vector<bool>(mesh.triangles.size())};
  const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
  for_each_edge(sides, [&](std::span<const HalfEdge> edge) {
    if (edge.size() == 1) result.has_border[edge[0].triangle] = true;
    if (edge.size() != 2) return;
    const bool agrees = winding_agrees(edge[0], edge[1]);
    result.of_triangle[edge[0].triangle][edge[0].side] = {edge[1].triangle, agrees};
    result.of_triangle[edge[1].triangle][edge[1].side] = {edge[0].triangle, agrees};
  });
  return result;
}

// Triangles that are connected by edges of two triangles.
struct Part {
  std::vector<int> triangles, turned;  // `turned` must be turned over to agree with the first one
  bool has_border = false;
};

// Breadth first, over edges of two triangles.
Part part_from(int first, const Neighbours& neighbours, std::vector<signed char>& sign) {
  Part part;
  sign[first] = 1;
  part.triangles.push_back(first);
  for (std::size_t i = 0; i < part.triangles.size(); ++i) {
    const int t = part.triangles[i];
    if (sign[t] < 0) part.turned.push_back(t);
    part.has_border = part.has_border || neighbours.has_border[t];
    for (const auto& [next, agrees] : neighbours.of_triangle[t]) {
      if (next < 0 || sign[next] != 0) continue;
      sign[next] = static_cast<signed char>(agrees ? sign[t] : -sign[t]);
      part.triangles.push_back(next);
    }
  }
  return part;
}

Vector3d twice_area(const RawMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
}

double area_of(const RawMesh& mesh, const std::vector<int>& triangles) {
  double sum = 0;
  for (const int t : triangles) sum += twice_area(mesh, t).norm() / 2;
  return sum;
}

// The volume that the triangles enclose; negative where they are turned inwards.
double volume_of(const RawMesh& mesh, const std::vector<int>& triangles) {
  double sum = 0;
  for (const int t : triangles)
    sum += twice_area(mesh, t).dot(mesh.vertices[mesh.triangles[t][0]] - mesh.vertices[0]) / 6;
  return sum;
}

void turn_over(RawMesh& mesh, const std::vector<int>& triangles) {
  for (const int t : triangles) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

void turn_smaller_area(RawMesh& mesh, const Part& part) {
  if (2 * area_of(mesh, part.turned) <= area_of(mesh, part.triangles))
    return turn_over(mesh, part.turned);
  turn_over(mesh, part.triangles);
  turn_over(mesh, part.turned);  // twice: as before
}

}  // namespace

void make_winding_consistent(RawMesh& mesh) {
  const Neighbours neighbours = neighbours_of(mesh);
  std::vector<signed char> sign(mesh.triangles.size(), 0);
  std::vector<Part> closed;
  double volume = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    if (sign[t] != 0) continue;
    Part part = part_from(t, neighbours, sign);
    turn_smaller_area(mesh, part);
    if (part.has_border) continue;
    volume += volume_of(mesh, part.triangles);
    closed.push_back(std::move(part));
  }
  for (const Part& part : closed) {
    const bool may_be_cavity = part.turned.empty() && volume > 0;
    if (volume_of(mesh, part.triangles) < 0 && !may_be_cavity) turn_over(mesh, part.triangles);
  }
}

}  // namespace edgescout
