#include "host/model/edge_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/io/binary_file.h"
#include "host/io/mesh_edges.h"
#include "host/model/mesh_edge_kind.h"
#include "host/model/surface_points.h"
#include "host/model/template_parts.h"
#include "host/model/union_find.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Averages over the corners that share a vertex and are connected by smooth edges: one piece of
// surface. Where the windings of two triangles disagree, a mean has no side.
std::vector<std::array<Eigen::Vector3d, 3>> average_normals(const Mesh& mesh,
                                                            std::span<const MeshEdge> edges) {
  UnionFind groups(3 * mesh.triangles.size());  // of corners 3 * triangle + corner
  const auto join_at = [&](const HalfEdge& a, const HalfEdge& b) {
    const auto corner = [](const HalfEdge& h, int place) {
      return 3 * h.triangle + (h.side + place) % 3;
    };
    groups.join(corner(a, 0), corner(b, 1));
    groups.join(corner(a, 1), corner(b, 0));
  };
  for (const auto& [sides, kind] : edges)
    if (kind == MeshEdge::Kind::Smooth && sides.size() == 2 && winding_agrees(sides[0], sides[1]))
      join_at(sides[0], sides[1]);
  std::vector<Eigen::Vector3d> sum(3 * mesh.triangles.size(), Eigen::Vector3d::Zero());
  for (int t = 0; t < int(mesh.triangles.size()); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d twice_area =
        (mesh.vertices_m[b] - mesh.vertices_m[a]).cross(mesh.vertices_m[c] - mesh.vertices_m[a]);
    for (int corner = 0; corner < 3; ++corner) sum[groups.root(3 * t + corner)] += twice_area;
  }
  std::vector<std::array<Eigen::Vector3d, 3>> normals(mesh.triangles.size());
  for (int t = 0; t < int(mesh.triangles.size()); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d& total = sum[groups.root(3 * t + corner)];
      normals[t][corner] = total.norm() > 0 ? total.normalized() : mesh.face_normals[t];
    }
  return normals;
}

std::vector<EdgeModel::Segment> drawn_edges(const Mesh& mesh, std::span<const MeshEdge> edges) {
  std::vector<EdgeModel::Segment> drawn;
  for (const auto& [sides, kind] : edges)
    if (kind != MeshEdge::Kind::Smooth)
      drawn.push_back({mesh.vertices_m[sides[0].low], mesh.vertices_m[sides[0].high],
                       kind == MeshEdge::Kind::OpenBorder});
  return drawn;
}

constexpr int SURFACE_POINTS = 600;

bool is_curved(const std::array<Eigen::Vector3d, 3>& normals) {
  constexpr double cos_flat = 1 - 1e-6;
  return normals[0].dot(normals[1]) < cos_flat || normals[1].dot(normals[2]) < cos_flat;
}

void require_few_points(const EdgeModel& model) {
  constexpr double most = 1e6;
  double length_m = 0;
  for (const EdgeModel::Segment& crease : model.creases)
    length_m += (crease.to_m - crease.from_m).norm();
  if (!(length_m / model.raster_step_m <= most))
    throw InputError(model.mesh.name, "raster step",
                     fmt::format("{:g} m for edges of {:g} m", model.raster_step_m, length_m),
                     fmt::format("at least {:g} m", length_m / most));
}

}  // namespace

void describe(EdgeModelOptions& o, OptionVisitor& visit) {
  visit.number({"crease-angle",
                "Mesh edges are drawn where the normals of their faces differ by more than this, "
                "degrees"},
               o.crease_angle_deg, 1.0, 179.0);
  visit.number({"raster-step", "Distance between the points of drawn edges, m. 0: diameter / 80"},
               o.raster_step_m, 0.0, 0.99);
}

void EdgeModelOptions::validate() const { check_bounds(*this, "model"); }

EdgeModel make_edge_model(const Mesh& mesh, const EdgeModelOptions& options) {
  EdgeModel model = edge_model_with(mesh, options, {});
  model.occluding = occluding_surface(mesh);
  return model;
}

EdgeModel edge_model_with(const Mesh& mesh, const EdgeModelOptions& options,
                          OccludingSurface occluding) {
  options.validate();
  const double cos_crease = std::cos(options.crease_angle_deg * std::numbers::pi / 180);
  const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
  const std::vector<MeshEdge> edges = mesh_edges(mesh, sides, cos_crease);
  EdgeModel model;
  model.mesh = mesh;
  model.raster_step_m = options.raster_step_m > 0 ? options.raster_step_m : mesh.diameter_m / 80;
  model.center_m = 0.5 * (mesh.box_min_m + mesh.box_max_m);
  for (const Eigen::Vector3d& vertex : mesh.vertices_m)
    model.radius_m = std::max(model.radius_m, (vertex - model.center_m).norm());
  model.creases = drawn_edges(mesh, edges);
  require_few_points(model);
  for (const EdgeModel::Segment& crease : model.creases)
    add_raster_points(crease.from_m, crease.to_m, model.raster_step_m, model.crease_points);
  model.corner_normals = average_normals(mesh, edges);
  for (int t = 0; t < int(mesh.triangles.size()); ++t)
    if (is_curved(model.corner_normals[t])) model.curved.push_back(t);
  if (model.crease_points.empty() && model.curved.empty())
    throw InputError(mesh.name, "edges", "none to draw",
                     "a mesh with creases, open borders or curved faces, a smaller raster step");
  model.surface_points =
      sample_surface(mesh, std::ranges::any_of(model.creases, &EdgeModel::Segment::is_open_border),
                     SURFACE_POINTS);
  model.occluding = std::move(occluding);
  return model;
}

void add_raster_points(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m,
                       double raster_step_m, std::vector<RasterPoint>& points) {
  const Eigen::Vector3d along = to_m - from_m;
  const double length = along.norm();
  if (length <= 0) return;
  const Eigen::Vector3d tangent = along / length;
  const double place =
      std::abs(from_m.dot(Eigen::Vector3d(12.9898, 78.233, 37.719)) / raster_step_m) * 43.7585453;
  const double dither = place - std::floor(place);
  const int count = static_cast<int>(length / raster_step_m + dither);
  for (int i = 0; i < count; ++i) points.push_back({from_m + along * ((i + 0.5) / count), tangent});
}

std::uint64_t fingerprint(const EdgeModel& model) {
  BinaryWriter out;
  for (const Eigen::Vector3d& vertex : model.mesh.vertices_m) out.put_point(vertex);
  out.put_list(model.mesh.triangles);
  for (const EdgeModel::Segment& crease : model.creases) {
    out.put_point(crease.from_m);
    out.put_point(crease.to_m);
  }
  out.put(model.raster_step_m);
  return checksum(out.bytes);
}

}  // namespace edgescout
