#include "host/model/mesh_quality.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "host/core/log.h"
#include "host/io/mesh_edges.h"
#include "host/model/union_find.h"

namespace edgescout {

namespace {

constexpr double most_open_border = 0.1, most_short_edges = 0.5;  // of the drawn length
constexpr double most_turn = std::numbers::pi / 4;                // between pieces of one edge

using Segment = EdgeModel::Segment;

double length_of(const Segment& s) { return (s.to_m - s.from_m).norm(); }

// Joins two pieces that meet where no other does, unless the edge has a corner there.
UnionFind whole_edges(const std::vector<Segment>& pieces) {
  std::map<std::array<double, 3>, std::vector<int>> pieces_at;
  for (int i = 0; i < int(pieces.size()); ++i)
    for (const Eigen::Vector3d& end : {pieces[i].from_m, pieces[i].to_m})
      pieces_at[{end.x(), end.y(), end.z()}].push_back(i);
  const auto direction_from = [&](int piece, const std::array<double, 3>& end) {
    const Segment& s = pieces[piece];
    const Eigen::Vector3d along = (s.to_m - s.from_m).normalized();
    return s.from_m == Eigen::Vector3d(end.data()) ? along : Eigen::Vector3d(-along);
  };
  UnionFind edges(pieces.size());
  for (const auto& [end, at] : pieces_at)
    if (at.size() == 2 &&
        direction_from(at[0], end).dot(direction_from(at[1], end)) < -std::cos(most_turn))
      edges.join(at[0], at[1]);
  return edges;
}

double length_of_short_edges(const EdgeModel& model) {
  UnionFind edges = whole_edges(model.creases);
  std::vector<double> length_m(model.creases.size(), 0);
  for (int i = 0; i < int(model.creases.size()); ++i)
    length_m[edges.root(i)] += length_of(model.creases[i]);
  double sum_m = 0;
  for (const double length : length_m)
    if (length < model.raster_step_m) sum_m += length;
  return sum_m;
}

std::size_t count_inconsistent_edges(const Mesh& mesh) {
  std::size_t count = 0;
  const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
  for_each_edge(sides, [&](std::span<const HalfEdge> edge) {
    count += edge.size() == 2 && !winding_agrees(edge[0], edge[1]);
  });
  return count;
}

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

}  // namespace

MeshQuality mesh_quality(const EdgeModel& model) {
  MeshQuality quality;
  double open_m = 0;
  for (const Segment& edge : model.creases) {
    quality.drawn_m += length_of(edge);
    if (edge.is_open_border) open_m += length_of(edge);
  }
  if (quality.drawn_m > 0) {
    quality.open_border_share = open_m / quality.drawn_m;
    quality.short_edge_share = length_of_short_edges(model) / quality.drawn_m;
  }
  quality.inconsistent_edges = count_inconsistent_edges(model.mesh);
  return quality;
}

std::string mesh_warning(const EdgeModel& model) {
  const MeshQuality quality = mesh_quality(model);
  std::string text;
  const auto add = [&](const std::string& found) { text += (text.empty() ? "" : "; ") + found; };
  if (quality.open_border_share > most_open_border)
    add(percent(quality.open_border_share) +
        " of the drawn edge length is open border: faces are missing or do not meet");
  if (quality.short_edge_share > most_short_edges)
    add(percent(quality.short_edge_share) +
        " of the drawn edge length is in edges shorter than the raster step: the surface is rough");
  if (quality.inconsistent_edges > 0)
    add("no winding of the faces is consistent at " + std::to_string(quality.inconsistent_edges) +
        " edges");
  return text.empty() ? "" : "mesh " + model.mesh.name + ": " + text;
}

void warn_of_mesh(const EdgeModel& model) {
  if (const std::string warning = mesh_warning(model); !warning.empty())
    log(LogLevel::Warning, warning);
}

}  // namespace edgescout
