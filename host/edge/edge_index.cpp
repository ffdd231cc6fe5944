#include "host/edge/edge_index.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/error.h"

namespace edgescout {

namespace {

// Rounding towards zero is that towards minus infinity here: what is negative falls in cell 0.
int cell_of(float position_px, int cell_px, int cells) {
  return std::clamp(static_cast<int>(position_px / float(cell_px)), 0, cells - 1);
}

}  // namespace

EdgeReach::EdgeReach(float given_radius_px, float max_turn_rad)
    : radius_px(given_radius_px), max_sine2(std::numeric_limits<float>::infinity()) {
  check(radius_px <= EdgeIndex::MAX_RADIUS_PX, "EdgeReach: radius");
  if (max_turn_rad < std::numbers::pi_v<float> / 2)
    max_sine2 = std::sin(max_turn_rad) * std::sin(max_turn_rad);
}

EdgeIndex::EdgeIndex(std::span<const EdgePoint> edges, int width, int height)
    : columns_(std::max(1, (width + CELL_WIDTH_PX - 1) / CELL_WIDTH_PX)),
      rows_(std::max(1, (height + CELL_HEIGHT_PX - 1) / CELL_HEIGHT_PX)),
      points_(edges.begin(), edges.end()),
      by_cell_(edges.size()) {
  const auto cell = [&](const EdgePoint& e) {
    return cell_of(e.y_px, CELL_HEIGHT_PX, rows_) * columns_ +
           cell_of(e.x_px, CELL_WIDTH_PX, columns_);
  };
  cell_end_.assign(std::size_t(columns_) * rows_ + 1, 0);
  for (const EdgePoint& edge : edges) ++cell_end_[cell(edge) + 1];
  for (std::size_t c = 1; c < cell_end_.size(); ++c) cell_end_[c] += cell_end_[c - 1];
  std::vector<std::uint32_t> next(cell_end_.begin(), cell_end_.end() - 1);
  for (const EdgePoint& edge : edges) by_cell_[next[cell(edge)]++] = edge;
  for (const EdgePoint& edge : by_cell_)
    cell_points_.push_back(
        {edge.x_px, edge.y_px, -std::sin(edge.theta_rad), std::cos(edge.theta_rad)});
}

EdgeIndex::Cells EdgeIndex::cells_around(float x_px, float y_px, float radius_px) const {
  if (!(x_px > -radius_px && y_px > -radius_px && x_px < CELL_WIDTH_PX * columns_ + radius_px &&
        y_px < CELL_HEIGHT_PX * rows_ + radius_px))
    return {0, -1, 0, -1};
  return {cell_of(x_px - radius_px, CELL_WIDTH_PX, columns_),
          cell_of(x_px + radius_px, CELL_WIDTH_PX, columns_),
          cell_of(y_px - radius_px, CELL_HEIGHT_PX, rows_),
          cell_of(y_px + radius_px, CELL_HEIGHT_PX, rows_)};
}

// Distances are not negative, so their bits are ordered as they are. With the point's number behind
// them the least key is that of the nearest point, the first of several, without a second branch.
const EdgePoint* EdgeIndex::nearest(const Eigen::Vector2f& place_px,
                                    const Eigen::Vector2f& direction,
                                    const EdgeReach& reach) const {
  const auto key_of = [](float distance2, std::uint32_t number) {
    return std::uint64_t(std::bit_cast<std::uint32_t>(distance2)) << 32 | number;
  };
  const Cells cells = cells_around(place_px.x(), place_px.y(), reach.radius_px);
  const float max_dot2 = reach.max_sine2 * direction.squaredNorm();
  const std::uint64_t none = key_of(reach.radius_px * reach.radius_px, 0);
  std::uint64_t best = none;
  for (int y = cells.y0; y <= cells.y1; ++y) {
    const std::uint32_t end = cell_end_[y * columns_ + cells.x1 + 1];
    for (std::uint32_t i = cell_end_[y * columns_ + cells.x0]; i < end; ++i) {
      const CellPoint& point = cell_points_[i];
      const float dx = point.x_px - place_px.x(), dy = point.y_px - place_px.y(),
                  dot = point.nx * direction.x() + point.ny * direction.y();
      if (dot * dot < max_dot2) best = std::min(best, key_of(dx * dx + dy * dy, i));
    }
  }
  return best == none ? nullptr : &by_cell_[std::uint32_t(best)];
}

}  // namespace edgescout
