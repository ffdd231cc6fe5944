#include "host/edge/edge_index.h"

#include <algorithm>
#include <cmath>

#include "kernels/error.h"

namespace edgescout {

namespace {
// Rounding towards zero is that towards minus infinity here: what is negative falls in cell 0.
int cell_of(float position_px, int cells) {
  return std::clamp(static_cast<int>(position_px / EdgeIndex::CELL_PX), 0, cells - 1);
}
}  // namespace

EdgeIndex::EdgeIndex(std::span<const EdgePoint> edges, int width, int height)
    : columns_(std::max(1, (width + CELL_PX - 1) / CELL_PX)),
      rows_(std::max(1, (height + CELL_PX - 1) / CELL_PX)),
      points_(edges.begin(), edges.end()),
      by_cell_(edges.size()) {
  const auto cell = [&](const EdgePoint& e) {
    return cell_of(e.y_px, rows_) * columns_ + cell_of(e.x_px, columns_);
  };
  cell_end_.assign(std::size_t(columns_) * rows_ + 1, 0);
  for (const EdgePoint& edge : edges) ++cell_end_[cell(edge) + 1];
  for (std::size_t c = 1; c < cell_end_.size(); ++c) cell_end_[c] += cell_end_[c - 1];
  std::vector<std::uint32_t> next(cell_end_.begin(), cell_end_.end() - 1);
  for (const EdgePoint& edge : edges) by_cell_[next[cell(edge)]++] = edge;
}

EdgeIndex::Cells EdgeIndex::cells_around(float x_px, float y_px, float radius_px) const {
  check(radius_px <= MAX_RADIUS_PX, "EdgeIndex: radius");
  if (!(x_px > -radius_px && y_px > -radius_px && x_px < CELL_PX * columns_ + radius_px &&
        y_px < CELL_PX * rows_ + radius_px))
    return {0, -1, 0, -1};
  return {cell_of(x_px - radius_px, columns_), cell_of(x_px + radius_px, columns_),
          cell_of(y_px - radius_px, rows_), cell_of(y_px + radius_px, rows_)};
}

const EdgePoint* EdgeIndex::nearest(float x_px, float y_px, float theta_rad, float radius_px,
                                    float max_turn_rad) const {
  constexpr float pi = 3.14159265f;
  const EdgePoint* best = nullptr;
  float best2 = radius_px * radius_px;
  for_each_near(x_px, y_px, radius_px, [&](const EdgePoint& edge) {
    const float dx = edge.x_px - x_px, dy = edge.y_px - y_px, distance2 = dx * dx + dy * dy;
    if (distance2 >= best2) return;
    const float turn = std::fabs(edge.theta_rad - theta_rad);
    if (std::min(turn, pi - turn) >= max_turn_rad) return;
    best = &edge;
    best2 = distance2;
  });
  return best;
}

}  // namespace edgescout
