#include "host/render/triangulate.h"

#include <algorithm>
#include <numeric>

#include "kernels/error.h"

namespace edgescout {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(b - a, c - a);
}

bool inside(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
            const Eigen::Vector2d& c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

bool segments_cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                    const Eigen::Vector2d& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

class EarClipper {
 public:
  EarClipper(const Loop2d& outline, const std::vector<Loop2d>& holes)
      : points_(outline), ring_(outline.size()) {
    std::iota(ring_.begin(), ring_.end(), 0);
    std::vector<std::vector<int>> rings;
    for (const Loop2d& hole : holes) {
      rings.emplace_back(hole.size());
      std::iota(rings.back().begin(), rings.back().end(), static_cast<int>(points_.size()));
      points_.insert(points_.end(), hole.begin(), hole.end());
    }
    // Rightmost hole first: its bridge to the right cannot be blocked by another hole (Eberly,
    // "Triangulation by Ear Clipping").
    const auto right = [&](const std::vector<int>& ring) {
      double x = points_[ring[0]].x();
      for (const int i : ring) x = std::max(x, points_[i].x());
      return x;
    };
    std::stable_sort(rings.begin(), rings.end(),
                     [&](const auto& a, const auto& b) { return right(a) > right(b); });
    for (std::size_t i = 0; i < rings.size(); ++i) bridge(rings, i);
  }

  std::vector<std::array<int, 3>> clip() {
    std::vector<std::array<int, 3>> triangles;
    while (ring_.size() > 3) {
      const std::size_t ear = best_ear();
      triangles.push_back(corner(ear));
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({ring_[0], ring_[1], ring_[2]});
    return triangles;
  }

 private:
  std::array<int, 3> corner(std::size_t i) const {
    const std::size_t n = ring_.size();
    return {ring_[(i + n - 1) % n], ring_[i], ring_[(i + 1) % n]};
  }

  // Joins a hole to the ring by the shortest segment that crosses nothing. The ring then goes to
  // the hole, around it, and back.
  void bridge(const std::vector<std::vector<int>>& holes, std::size_t which) {
    const std::vector<int>& hole = holes[which];
    double shortest = std::numeric_limits<double>::infinity();
    std::size_t from = 0, to = 0;
    for (std::size_t r = 0; r < ring_.size(); ++r)
      for (std::size_t h = 0; h < hole.size(); ++h) {
        const double length = (points_[ring_[r]] - points_[hole[h]]).squaredNorm();
        if (length >= shortest || blocked(ring_[r], hole[h], holes, which) ||
            !opens_inwards(r, hole[h]))
          continue;
        shortest = length;
        from = r;
        to = h;
      }
    check(std::isfinite(shortest), "triangulate: a hole does not lie inside the outline");
    std::vector<int> walk{hole.begin() + static_cast<std::ptrdiff_t>(to), hole.end()};
    walk.insert(walk.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    walk.push_back(ring_[from]);
    ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(from) + 1, walk.begin(), walk.end());
  }

  // Returns whether the point lies in the wedge of the polygon's inside at ring corner r.
  bool opens_inwards(std::size_t r, int point) const {
    const auto [before, at, after] = corner(r);
    const Eigen::Vector2d &a = points_[before], &b = points_[at], &c = points_[after],
                          &p = points_[point];
    if (turn(a, b, c) >= 0) return turn(a, b, p) > 0 && turn(b, c, p) > 0;
    return turn(a, b, p) > 0 || turn(b, c, p) > 0;
  }

  bool blocked(int a, int b, const std::vector<std::vector<int>>& holes,
               std::size_t first_free) const {
    const auto crosses = [&](const std::vector<int>& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (segments_cross(points_[a], points_[b], points_[ring[i]],
                           points_[ring[(i + 1) % ring.size()]]))
          return true;
      return false;
    };
    return crosses(ring_) || std::any_of(holes.begin() + static_cast<std::ptrdiff_t>(first_free),
                                         holes.end(), crosses);
  }

  // Measures how far the corner's triangle is from a sliver: 2 * area over the squared longest
  // side. Not positive if the corner is no ear.
  double quality(std::size_t i) const {
    const auto [ia, ib, ic] = corner(i);
    const Eigen::Vector2d &a = points_[ia], &b = points_[ib], &c = points_[ic];
    const double longest =
        std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
    const double value = turn(a, b, c) / longest;
    if (value < 1e-9) return 0;
    for (const int k : ring_) {
      const Eigen::Vector2d& p = points_[k];
      if (p != a && p != b && p != c && inside(p, a, b, c)) return 0;
    }
    return value;
  }

  std::size_t best_ear() const {
    std::size_t best = 0;
    double best_quality = 0;
    for (std::size_t i = 0; i < ring_.size(); ++i)
      if (const double q = quality(i); q > best_quality) {
        best = i;
        best_quality = q;
      }
    check(best_quality > 0, "triangulate: the outline is not a simple counter-clockwise polygon");
    return best;
  }

  Loop2d points_;
  std::vector<int> ring_;  // the outline and the holes joined to it so far, as one loop
};

}  // namespace

std::vector<std::array<int, 3>> triangulate(const Loop2d& outline,
                                            const std::vector<Loop2d>& holes) {
  check(outline.size() >= 3 && signed_area(outline) > 0,
        "triangulate: the outline must run counter-clockwise");
  for (const Loop2d& hole : holes)
    check(hole.size() >= 3 && signed_area(hole) < 0, "triangulate: holes must run clockwise");
  return EarClipper(outline, holes).clip();
}

double signed_area(const Loop2d& loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    twice += cross(loop[i], loop[(i + 1) % loop.size()]);
  return 0.5 * twice;
}

}  // namespace edgescout
