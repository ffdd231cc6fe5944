// Finds the edge point closest to an oriented image point in the joint space of place and direction
// (paper, Eq. 4; Liu et al., IJRR 2012).
#pragma once

#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

// The distance |x - e| + lambda * |theta - theta_e|_pi is exact: directions are not rounded to
// bins. Directions have no sign. Edge points outside the image are left out.
class JointIndex {
 public:
  JointIndex(std::span<const EdgePoint> edges, int width, int height, float lambda_px_per_rad);
  // (x, y) may lie outside the image; theta in [0, pi]. Null where there are no edge points, and
  // for a place that is not finite or so far that a float cannot hold the square of its distance.
  const EdgePoint* closest(float x_px, float y_px, float theta_rad) const;

  static constexpr int CELL_PX = 16;
  static constexpr int SECTORS = 12;  // of directions; each has its own grid

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
  std::vector<EdgePoint> points_;  // by sector and cell
  // Points of cell c are points_[cell_end_[c]] up to points_[cell_end_[c + 1]].
  std::vector<std::uint32_t> cell_end_;
};

}  // namespace edgescout
