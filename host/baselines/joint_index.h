// The edge point closest to an oriented image point in the joint space of place and direction
// (paper, Eq. 4; Liu et al., IJRR 2012).
#pragma once

#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

// Exact: |x - e| + lambda * |theta - theta_e|_pi, directions undirected and not rounded to bins.
// Edge points outside the image are left out.
class JointIndex {
 public:
  JointIndex(std::span<const EdgePoint> edges, int width, int height, float lambda_px_per_rad);
  // Null where there are no edge points at all, and of a place that is not finite or too far for a
  // float to hold the square of its distance. (x, y) may lie outside the image; theta in [0, pi].
  const EdgePoint* closest(float x_px, float y_px, float theta_rad) const;

  static constexpr int CELL_PX = 16;
  static constexpr int SECTORS = 12;  // of directions, a grid each

 private:
  struct Query {
    float x_px, y_px, theta_rad;
  };
  struct Best {
    const EdgePoint* edge = nullptr;
    float cost_px;
  };
  void search_sector(int sector, const Query& query, Best& best) const;
  void search_cell(int sector, int column, int row, const Query& query, Best& best) const;

  int columns_, rows_;
  float lambda_px_per_rad_;
  std::vector<EdgePoint> points_;        // by sector and cell
  std::vector<std::uint32_t> cell_end_;  // points of cell c: [cell_end_[c], cell_end_[c + 1])
};

}  // namespace edgescout
