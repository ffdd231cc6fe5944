#include "host/io/mesh_diameter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace edgescout {

using Eigen::Vector3d;

namespace {

constexpr int cells_per_axis = 12;

struct Cell {
  Vector3d min, max;  // of the points inside
  std::vector<Vector3d> points;
};

const Vector3d& farthest_from(const Vector3d& x, const std::vector<Vector3d>& points) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
    return (a - x).squaredNorm() < (b - x).squaredNorm();
  });
}

// Finds a good lower bound: goes from a point to the farthest point from it, and repeats.
double farthest_pair_guess(const std::vector<Vector3d>& points) {
  Vector3d from = points.front();
  double best = 0;
  for (int round = 0; round < 4; ++round) {
    const Vector3d to = farthest_from(from, points);
    best = std::max(best, (to - from).squaredNorm());
    from = to;
  }
  return best;
}

std::vector<Cell> occupied_cells(const std::vector<Vector3d>& points) {
  Vector3d low = points.front(), high = points.front();
  for (const Vector3d& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double side = std::max((high - low).maxCoeff() / cells_per_axis, 1e-300);
  std::vector<Cell> cells(cells_per_axis * cells_per_axis * cells_per_axis);
  for (const Vector3d& x : points) {
    const Eigen::Array3i at = ((x - low) / side).cast<int>().array().min(cells_per_axis - 1);
    Cell& cell = cells[(at.z() * cells_per_axis + at.y()) * cells_per_axis + at.x()];
    cell.min = cell.points.empty() ? x : Vector3d(cell.min.cwiseMin(x));
    cell.max = cell.points.empty() ? x : Vector3d(cell.max.cwiseMax(x));
    cell.points.push_back(x);
  }
  std::erase_if(cells, [](const Cell& cell) { return cell.points.empty(); });
  return cells;
}

double largest_between(const Cell& a, const Cell& b) {
  double best = 0;
  for (const Vector3d& x : a.points)
    for (const Vector3d& y : b.points) best = std::max(best, (x - y).squaredNorm());
  return best;
}

}  // namespace

double largest_distance(const std::vector<Vector3d>& points) {
  if (points.size() < 2) return 0;
  double best = farthest_pair_guess(points);
  const std::vector<Cell> cells = occupied_cells(points);
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = i; j < cells.size(); ++j) {
      const Vector3d reach = (cells[i].max - cells[j].min).cwiseMax(cells[j].max - cells[i].min);
      if (reach.squaredNorm() > best) best = std::max(best, largest_between(cells[i], cells[j]));
    }
  return std::sqrt(best);
}

}  // namespace edgescout
