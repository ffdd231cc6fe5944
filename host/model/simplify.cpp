// Edge collapse with an error bound.
//
// Every triangle carries an estimate of its distance from the fine surface that it stands for. A
// removed vertex adds the distance between the triangles before and after to the estimate. In the
// end the distance of every fine vertex is measured. Simplifiers by quadric error limit a mean,
// which single vertices exceed five times.
#include "host/model/simplify.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "host/model/triangle_grid.h"

namespace edgescout {

namespace {

using Eigen::Vector3d;
using Corners = std::array<int, 3>;

constexpr double infinity = std::numeric_limits<double>::infinity();
// A move may turn a triangle by 60 degrees. More could fold the surface.
constexpr double least_cosine = 0.5;

// The neighbours of a vertex in the order of its triangles: a closed ring, or at a border a chain.
struct Ring {
  std::vector<int> vertices;
  bool is_closed = false;
};

struct Move {
  double error_m = infinity;  // of the triangles that it makes
  int from = -1, to = -1;
};

bool has(const auto& list, int value) { return std::ranges::find(list, value) != list.end(); }

// Chains sides end to end. None: they are not one chain or one ring.
std::optional<Ring> chained(std::vector<std::pair<int, int>> sides) {
  const auto ends_at = [&](int v) {
    return std::ranges::find(sides, v, &std::pair<int, int>::second) != sides.end();
  };
  const auto first = std::ranges::find_if(sides, [&](const auto& s) { return !ends_at(s.first); });
  Ring ring;
  ring.is_closed = first == sides.end();
  ring.vertices.push_back(ring.is_closed ? sides[0].first : first->first);
  while (!sides.empty()) {
    const auto next = std::ranges::find(sides, ring.vertices.back(), &std::pair<int, int>::first);
    if (next == sides.end() || (has(ring.vertices, next->second) && sides.size() > 1))
      return std::nullopt;
    ring.vertices.push_back(next->second);
    sides.erase(next);
  }
  if (ring.is_closed) ring.vertices.pop_back();
  return ring;
}

class Simplifier {
 public:
  Simplifier(const Mesh& mesh, double error_m)
      : vertices_(mesh.vertices_m),
        triangles_(mesh.triangles),
        error_m_(mesh.triangles.size(), 0),
        around_(mesh.vertices_m.size()),
        most_m_(error_m),
        best_(mesh.vertices_m.size()),
        is_stale_(mesh.vertices_m.size(), true) {
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (const int v : triangles_[t]) around_[v].push_back(int(t));
  }

  // First the moves that change little: an early large one would be a loss to later ones.
  std::vector<Corners> simplified() {
    for (int halvings = 6; halvings >= 0; --halvings)
      while (make_moves(std::ldexp(most_m_, -halvings))) {
      }
    std::erase_if(triangles_, [](const Corners& corners) { return corners[0] < 0; });
    return std::move(triangles_);
  }

 private:
  // Makes the best moves first, and none beside another one: its error would be another. False
  // where few are left.
  bool make_moves(double limit_m) {
    std::vector<Move> moves;
    for (int v = 0; v < int(vertices_.size()); ++v) {
      if (is_stale_[v]) best_[v] = best_move(v);
      is_stale_[v] = false;
      if (best_[v].error_m <= limit_m) moves.push_back(best_[v]);
    }
    std::ranges::stable_sort(moves, {}, &Move::error_m);
    std::size_t made = 0;
    for (const Move& move : moves) {
      const std::vector<int> near = neighbours(move.from);
      if (std::ranges::any_of(near, [&](int v) { return is_stale_[v]; })) continue;
      for (const int v : near) is_stale_[v] = true;
      made += make(move);
    }
    return 1000 * made > vertices_.size();
  }

  // With repetitions, and with the vertex itself.
  std::vector<int> neighbours(int vertex) const {
    std::vector<int> list;
    for (const int t : around_[vertex])
      list.insert(list.end(), triangles_[t].begin(), triangles_[t].end());
    return list;
  }

  std::optional<Ring> ring_of(int vertex) const {
    std::vector<std::pair<int, int>> sides;
    for (const int t : around_[vertex]) {
      const Corners& c = triangles_[t];
      const auto at = std::size_t(std::ranges::find(c, vertex) - c.begin());
      sides.emplace_back(c[(at + 1) % 3], c[(at + 2) % 3]);
    }
    return sides.empty() ? std::nullopt : chained(std::move(sides));
  }

  // Error infinity: there is none.
  Move best_move(int vertex) const {
    const std::optional<Ring> ring = ring_of(vertex);
    std::vector<Move> moves;
    for (const int to : ring ? ring->vertices : std::vector<int>{}) {
      const bool is_end = to == ring->vertices.front() || to == ring->vertices.back();
      if (ring->is_closed || is_end) moves.push_back({distance_of_vertex(vertex, to), vertex, to});
    }
    std::ranges::stable_sort(moves, {}, &Move::error_m);
    for (Move& move : moves) {
      if (move.error_m > most_m_) break;
      if (!keeps_topology(*ring, move.to)) continue;
      move.error_m = std::max(move.error_m, distance_of_edges(*ring, move)) + error_of(vertex);
      return move;
    }
    return {infinity, vertex, -1};
  }

  // Link condition: the two ends of an edge share no neighbours but those opposite the edge.
  bool keeps_topology(const Ring& ring, int to) const {
    const std::vector<int> beside = neighbours(to);
    const auto shared =
        std::ranges::count_if(ring.vertices, [&](int v) { return v != to && has(beside, v); });
    return shared == (ring.is_closed ? 2 : 1);
  }

  double error_of(int vertex) const {
    double error_m = 0;
    for (const int t : around_[vertex]) error_m = std::max(error_m, error_m_[t]);
    return error_m;
  }

  TriangleGrid::Triangle triangle(const Corners& c) const {
    return {vertices_[c[0]], vertices_[c[1]], vertices_[c[2]]};
  }

  // From the vertex to the triangles after the move. Infinity where one would turn too far.
  double distance_of_vertex(int from, int to) const {
    double distance_m = infinity;
    for (const int t : around_[from]) {
      Corners corners = triangles_[t];
      if (has(corners, to)) continue;
      const Vector3d before = normal_of(corners);
      std::ranges::replace(corners, from, to);
      const Vector3d after = normal_of(corners);
      if (!(after.dot(before) > least_cosine * after.norm() * before.norm())) return infinity;
      distance_m = std::min(distance_m, distance_to_triangle(vertices_[from], triangle(corners)));
    }
    return distance_m;
  }

  // From the middles of the edges after the move to the triangles before it.
  double distance_of_edges(const Ring& ring, const Move& move) const {
    double largest_m = 0;
    for (const int v : ring.vertices) {
      const Vector3d middle = 0.5 * (vertices_[move.to] + vertices_[v]);
      double distance_m = infinity;
      for (const int t : around_[move.from])
        distance_m = std::min(distance_m, distance_to_triangle(middle, triangle(triangles_[t])));
      largest_m = std::max(largest_m, distance_m);
    }
    return largest_m;
  }

  Vector3d normal_of(const Corners& c) const {
    return (vertices_[c[1]] - vertices_[c[0]]).cross(vertices_[c[2]] - vertices_[c[0]]);
  }

  // False where moves beside this one have changed the topology. Its triangles are as they were.
  bool make(const Move& move) {
    const std::optional<Ring> ring = ring_of(move.from);
    if (!ring || !keeps_topology(*ring, move.to)) return false;
    for (const int t : around_[move.from]) {
      Corners& corners = triangles_[t];
      if (has(corners, move.to)) {
        for (const int v : corners)
          if (v != move.from) std::erase(around_[v], t);
        corners = {-1, -1, -1};
      } else {
        std::ranges::replace(corners, move.from, move.to);
        around_[move.to].push_back(t);
        error_m_[t] = move.error_m;
      }
    }
    around_[move.from].clear();
    return true;
  }

  const std::vector<Vector3d>& vertices_;
  std::vector<Corners> triangles_;        // {-1, -1, -1}: removed
  std::vector<double> error_m_;           // bound of each triangle's distance
  std::vector<std::vector<int>> around_;  // the triangles at each vertex
  double most_m_;
  std::vector<Move> best_;      // by vertex
  std::vector<bool> is_stale_;  // whose best move may be another
};

bool holds_all_vertices(const Mesh& mesh, const std::vector<Corners>& coarse, double error_m) {
  std::vector<TriangleGrid::Triangle> triangles;
  for (const auto& [a, b, c] : coarse)
    triangles.push_back({mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]});
  const TriangleGrid grid(std::move(triangles), error_m);
  return std::ranges::all_of(
      mesh.vertices_m, [&](const Vector3d& vertex) { return grid.is_within(vertex, error_m); });
}

}  // namespace

std::vector<Corners> simplify(const Mesh& mesh, double error_m) {
  for (const double share : {1.0, 0.5, 0.25}) {
    std::vector<Corners> coarse = Simplifier(mesh, share * error_m).simplified();
    if (holds_all_vertices(mesh, coarse, error_m)) return coarse;
  }
  return mesh.triangles;
}

}  // namespace edgescout
