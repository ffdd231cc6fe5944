#include "host/baselines/joint_index.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace edgescout {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float sector_rad = pi / JointIndex::SECTORS;

float turn_between(float a_rad, float b_rad) {
  const float turn = std::fabs(a_rad - b_rad);
  return std::min(turn, pi - turn);
}

int sector_of(float theta_rad) {
  return std::clamp(static_cast<int>(theta_rad / sector_rad), 0, JointIndex::SECTORS - 1);
}

// The turn from a direction to the nearest direction of a sector.
float turn_to_sector(float theta_rad, int sector) {
  if (sector_of(theta_rad) == sector) return 0;
  return std::min(turn_between(theta_rad, sector * sector_rad),
                  turn_between(theta_rad, (sector + 1) * sector_rad));
}

int cell_of(float position_px) {
  return static_cast<int>(std::floor(position_px / JointIndex::CELL_PX));
}

}  // namespace

JointIndex::JointIndex(std::span<const EdgePoint> edges, int width, int height,
                       float lambda_px_per_rad)
    : columns_((width + CELL_PX - 1) / CELL_PX),
      rows_((height + CELL_PX - 1) / CELL_PX),
      lambda_px_per_rad_(lambda_px_per_rad) {
  const auto inside = [&](const EdgePoint& e) {
    return e.x_px >= 0 && e.y_px >= 0 && e.x_px < float(width) && e.y_px < float(height);
  };
  const auto cell = [&](const EdgePoint& e) {
    return (std::size_t(sector_of(e.theta_rad)) * rows_ + cell_of(e.y_px)) * columns_ +
           cell_of(e.x_px);
  };
  cell_end_.assign(std::size_t(SECTORS) * rows_ * columns_ + 1, 0);
  for (const EdgePoint& edge : edges)
    if (inside(edge)) ++cell_end_[cell(edge) + 1];
  for (std::size_t c = 1; c < cell_end_.size(); ++c) cell_end_[c] += cell_end_[c - 1];
  std::vector<std::uint32_t> next(cell_end_.begin(), cell_end_.end() - 1);
  points_.resize(cell_end_.back());
  for (const EdgePoint& edge : edges)
    if (inside(edge)) points_[next[cell(edge)]++] = edge;
}

void JointIndex::search_cell(int sector, int column, int row, const Query& query,
                             Best& best) const {
  const std::size_t cell = (std::size_t(sector) * rows_ + row) * columns_ + column;
  for (std::uint32_t i = cell_end_[cell]; i < cell_end_[cell + 1]; ++i) {
    const EdgePoint& edge = points_[i];
    const float dx = edge.x_px - query.x_px, dy = edge.y_px - query.y_px,
                distance2 = dx * dx + dy * dy;
    const float turn_px = lambda_px_per_rad_ * turn_between(edge.theta_rad, query.theta_rad);
    const float reach_px = best.cost_px - turn_px;
    if (reach_px > 0 && distance2 < reach_px * reach_px)
      best = {&edge, turn_px + std::sqrt(distance2)};
  }
}

// Searches rings of cells about the query's nearest place in the image, until the nearest cell of a
// ring is too far. From outside the image, a cell is at least as far as the hypotenuse of the way
// to that place and the way from there to the cell.
void JointIndex::search_sector(int sector, const Query& query, Best& best) const {
  const float turn_px = lambda_px_per_rad_ * turn_to_sector(query.theta_rad, sector);
  const float x_px = std::clamp(query.x_px, 0.0f, float(columns_ * CELL_PX)),
              y_px = std::clamp(query.y_px, 0.0f, float(rows_ * CELL_PX)),
              outside_px = std::hypot(query.x_px - x_px, query.y_px - y_px);
  const int cx = std::min(cell_of(x_px), columns_ - 1), cy = std::min(cell_of(y_px), rows_ - 1);
  const int last = std::max({cx, columns_ - 1 - cx, cy, rows_ - 1 - cy});
  for (int ring = 0; ring <= last; ++ring) {
    if (turn_px + std::hypot(outside_px, float(std::max(0, ring - 1) * CELL_PX)) >= best.cost_px)
      return;
    for (int row = std::max(0, cy - ring); row <= std::min(rows_ - 1, cy + ring); ++row) {
      const int stride = std::abs(row - cy) == ring ? 1 : std::max(1, 2 * ring);
      for (int column = cx - ring; column <= cx + ring; column += stride)
        if (column >= 0 && column < columns_) search_cell(sector, column, row, query, best);
    }
  }
}

const EdgePoint* JointIndex::closest(float x_px, float y_px, float theta_rad) const {
  if (!std::isfinite(x_px) || !std::isfinite(y_px) || !std::isfinite(theta_rad)) return nullptr;
  const Query query{x_px, y_px, theta_rad};
  Best best{nullptr, std::numeric_limits<float>::max()};
  const int own = sector_of(theta_rad);
  // The own sector first, then its neighbours on both sides: most other sectors are then too far by
  // direction alone.
  for (int step = 0; step < SECTORS; ++step) {
    const int offset = step % 2 == 0 ? step / 2 : SECTORS - (step + 1) / 2;
    search_sector((own + offset) % SECTORS, query, best);
  }
  return best.edge;
}

}  // namespace edgescout
