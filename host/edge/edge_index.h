// Edge points of an image, found by place: a grid of cells.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

class EdgeIndex {
 public:
  EdgeIndex(std::span<const EdgePoint> edges, int width, int height);
  // The edge point nearest to (x, y) within `radius_px` (at most CELL_PX) whose direction differs from
  // `theta_rad` by less than `max_turn_rad`; null where there is none.
  const EdgePoint* nearest(float x_px, float y_px, float theta_rad, float radius_px,
                           float max_turn_rad) const;

  static constexpr int CELL_PX = 8;

 private:
  int columns_, rows_;
  std::vector<EdgePoint> points_;        // by cell
  std::vector<std::uint32_t> cell_end_;  // points of cell c: [cell_end_[c], cell_end_[c + 1])
};

}  // namespace edgescout
