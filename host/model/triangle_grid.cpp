#include "host/model/triangle_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace edgescout {

using Eigen::Vector3d;

namespace {

constexpr int cells_per_axis = 48;

double distance_to_segment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double s = squared > 0 ? std::clamp((x - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (x - a - s * along).norm();
}

}  // namespace

double distance_to_triangle(const Vector3d& x, const TriangleGrid::Triangle& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const auto inside = [&](int i) { return normal.cross(t[(i + 1) % 3] - t[i]).dot(x - t[i]) >= 0; };
  if (normal.squaredNorm() > 0 && inside(0) && inside(1) && inside(2))
    return std::abs(normal.normalized().dot(x - t[0]));
  return std::min({distance_to_segment(x, t[0], t[1]), distance_to_segment(x, t[1], t[2]),
                   distance_to_segment(x, t[2], t[0])});
}

TriangleGrid::TriangleGrid(std::vector<Triangle> triangles, double reach_m)
    : triangles_(std::move(triangles)), reach_m_(reach_m) {
  constexpr double far_m = std::numeric_limits<double>::infinity();
  Vector3d low = Vector3d::Constant(far_m), high = -low;
  for (const Triangle& triangle : triangles_)
    for (const Vector3d& x : triangle) low = low.cwiseMin(x), high = high.cwiseMax(x);
  origin_ = low.array() - reach_m;
  high.array() += reach_m;
  cell_m_ = (high - origin_).maxCoeff() / cells_per_axis;
  cells_ = ((high - origin_) / cell_m_).array().floor().cast<int>() + 1;
  first_.assign(std::size_t(cells_.prod()) + 1, 0);
  for (const Triangle& triangle : triangles_)
    for_each_cell(triangle, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  in_cells_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for_each_cell(triangles_[t], [&](std::size_t cell) { in_cells_[next[cell]++] = int(t); });
}

bool TriangleGrid::is_within(const Vector3d& x, double distance_m) const {
  const auto cell = cell_of(x);
  if (!cell) return false;
  return std::any_of(in_cells_.begin() + std::ptrdiff_t(first_[*cell]),
                     in_cells_.begin() + std::ptrdiff_t(first_[*cell + 1]),
                     [&](int t) { return distance_to_triangle(x, triangles_[t]) <= distance_m; });
}

std::optional<std::size_t> TriangleGrid::cell_of(const Vector3d& x) const {
  const Eigen::Array3d at = (x - origin_).array() / cell_m_;
  if (!(at >= 0).all() || !(at < cells_.cast<double>()).all()) return std::nullopt;
  const Eigen::Array3i cell = at.cast<int>();
  return (std::size_t(cell.z()) * cells_.y() + cell.y()) * cells_.x() + cell.x();
}

// The cells that the triangle may come within reach of: those its box touches, grown by the reach.
template <typename Visit>
void TriangleGrid::for_each_cell(const Triangle& t, Visit visit) const {
  const Vector3d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]) - origin_,
                 high = t[0].cwiseMax(t[1]).cwiseMax(t[2]) - origin_;
  const Eigen::Array3i first = ((low.array() - reach_m_) / cell_m_).floor().cast<int>().max(0);
  const Eigen::Array3i last =
      ((high.array() + reach_m_) / cell_m_).floor().cast<int>().min(cells_ - 1);
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x)
        visit((std::size_t(z) * cells_.y() + y) * cells_.x() + x);
}

}  // namespace edgescout
