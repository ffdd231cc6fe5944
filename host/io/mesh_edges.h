// The edges of a triangle mesh, each with the triangles that share it.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace edgescout {

// One side of a triangle: from its corner `side` to the next corner.
struct HalfEdge {
  int low, high;  // its vertices, the smaller index first
  int triangle, side;
  bool ascending;  // the triangle runs from `low` to `high`
  bool same_edge(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

// All sides of all triangles, sorted by edge and then by triangle.
inline std::vector<HalfEdge> sorted_half_edges(std::span<const std::array<int, 3>> triangles) {
  std::vector<HalfEdge> sides;
  sides.reserve(3 * triangles.size());
  for (int t = 0; t < int(triangles.size()); ++t)
    for (int side = 0; side < 3; ++side) {
      const int from = triangles[t][side], to = triangles[t][(side + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), t, side, from < to});
    }
  std::ranges::sort(sides, {}, [](const HalfEdge& h) {
    return std::array{h.low, h.high, h.triangle, h.side};
  });
  return sides;
}

// Calls visit(std::span<const HalfEdge>) for each edge, with all its sides.
template <typename Visit>
void for_each_edge(std::span<const HalfEdge> sorted, Visit visit) {
  for (std::size_t first = 0, end = 0; first < sorted.size(); first = end) {
    while (end < sorted.size() && sorted[end].same_edge(sorted[first])) ++end;
    visit(sorted.subspan(first, end - first));
  }
}

// Whether the two triangles of an edge agree on which of their faces is the outer one.
inline bool winding_agrees(const HalfEdge& a, const HalfEdge& b) {
  return a.ascending != b.ascending;
}

}  // namespace edgescout
