#include "host/model/mesh_edge_kind.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "host/model/triangle_grid.h"

namespace edgescout {

using Eigen::Vector3d;

namespace {

// Of the diameter: a face goes on beyond a border if it passes this near to the border's
// continuation, which is tried at twice this distance. It is the widest gap that make_mesh joins.
constexpr double reach_share = 3e-3;

// From the edge into one of its triangles, perpendicular to the edge; unit.
Vector3d into_triangle(const Mesh& mesh, const HalfEdge& side) {
  const Vector3d& from = mesh.vertices_m[side.low];
  const Vector3d along = (mesh.vertices_m[side.high] - from).normalized();
  const Vector3d to_corner =
      mesh.vertices_m[mesh.triangles[side.triangle][(side.side + 2) % 3]] - from;
  return (to_corner - to_corner.dot(along) * along).normalized();
}

bool is_smooth_between_two(const Mesh& mesh, const HalfEdge& a, const HalfEdge& b,
                           double cos_crease) {
  const double cosine = mesh.face_normals[a.triangle].dot(mesh.face_normals[b.triangle]);
  return (winding_agrees(a, b) ? cosine : -cosine) > cos_crease;
}

// Whether the triangles at an edge lie in two opposite directions from it.
bool is_smooth_between_many(const Mesh& mesh, std::span<const HalfEdge> edge, double cos_crease) {
  const Vector3d first = into_triangle(mesh, edge[0]);
  const auto cosine = [&](const HalfEdge& side) { return first.dot(into_triangle(mesh, side)); };
  return std::ranges::all_of(
             edge, [&](const HalfEdge& side) { return std::abs(cosine(side)) > cos_crease; }) &&
         std::ranges::any_of(edge, [&](const HalfEdge& side) { return cosine(side) < 0; });
}

MeshEdge::Kind kind_of(const Mesh& mesh, std::span<const HalfEdge> sides, double cos_crease) {
  if (sides.size() == 1) return MeshEdge::Kind::OpenBorder;
  const bool smooth = sides.size() == 2
                          ? is_smooth_between_two(mesh, sides[0], sides[1], cos_crease)
                          : is_smooth_between_many(mesh, sides, cos_crease);
  return smooth ? MeshEdge::Kind::Smooth : MeshEdge::Kind::Crease;
}

TriangleGrid grid_of(const Mesh& mesh) {
  std::vector<TriangleGrid::Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
    triangles.push_back({mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]});
  return {std::move(triangles), reach_share * mesh.diameter_m};
}

// Whether the surface goes on in the plane of the border's triangle, tried at three places.
bool goes_on_beyond(const Mesh& mesh, const HalfEdge& border, const TriangleGrid& surface,
                    double cos_crease) {
  const double reach_m = reach_share * mesh.diameter_m;
  const Vector3d& normal = mesh.face_normals[border.triangle];
  const Vector3d beyond_m = -2 * reach_m * into_triangle(mesh, border);
  return std::ranges::all_of(std::array{0.25, 0.5, 0.75}, [&](double s) {
    const Vector3d place =
        (1 - s) * mesh.vertices_m[border.low] + s * mesh.vertices_m[border.high] + beyond_m;
    bool found = false;
    surface.for_each_near(place, [&](int t) {
      found = found || (std::abs(mesh.face_normals[t].dot(normal)) > cos_crease &&
                        distance_to_triangle(place, surface.triangle(t)) <= reach_m);
    });
    return found;
  });
}

}  // namespace

std::vector<MeshEdge> mesh_edges(const Mesh& mesh, std::span<const HalfEdge> sorted,
                                 double cos_crease) {
  std::vector<MeshEdge> edges;
  bool has_border = false;
  for_each_edge(sorted, [&](std::span<const HalfEdge> sides) {
    has_border = has_border || sides.size() == 1;
    edges.push_back({sides, kind_of(mesh, sides, cos_crease)});
  });
  if (!has_border) return edges;
  const TriangleGrid surface = grid_of(mesh);
  for (MeshEdge& edge : edges)
    if (edge.kind == MeshEdge::Kind::OpenBorder &&
        goes_on_beyond(mesh, edge.sides[0], surface, cos_crease))
      edge.kind = MeshEdge::Kind::Smooth;
  return edges;
}

}  // namespace edgescout
