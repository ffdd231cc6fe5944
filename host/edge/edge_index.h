// Finds the edge points of an image by place, on a grid of cells.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

// Which edge points a lookup may find.
struct EdgeReach {
  // Closer than `radius_px`, at most EdgeIndex::MAX_RADIUS_PX. Directions, which have no sign,
  // differ by less than `max_turn_rad`; from a quarter turn on by any angle.
  EdgeReach(float radius_px, float max_turn_rad);

  float radius_px;
  float max_sine2;  // of the turn
};

class EdgeIndex {
 public:
  EdgeIndex(std::span<const EdgePoint> edges, int width, int height);

  // The edge point nearest to a place, px, and along a direction of any length other than 0. Null
  // where there is none within reach.
  const EdgePoint* nearest(const Eigen::Vector2f& place_px, const Eigen::Vector2f& direction,
                           const EdgeReach& reach) const;

  // The unit normal (-sin(theta), cos(theta)) of the edge's tangent. `edge` is one that this index
  // has found.
  Eigen::Vector2f normal_of(const EdgePoint& edge) const {
    const CellPoint& point = cell_points_[std::size_t(&edge - by_cell_.data())];
    return {point.nx, point.ny};
  }

  // Calls visit(const EdgePoint&) for every edge point within `radius_px` (at most MAX_RADIUS_PX)
  // of any direction. References stay valid as long as the index; one edge point has one address.
  template <typename Visit>
  void for_each_near(float x_px, float y_px, float radius_px, const Visit& visit) const {
    const Cells cells = cells_around(x_px, y_px, radius_px);
    for (int y = cells.y0; y <= cells.y1; ++y)
      for (std::uint32_t i = cell_end_[y * columns_ + cells.x0];
           i < cell_end_[y * columns_ + cells.x1 + 1]; ++i) {
        const float dx = by_cell_[i].x_px - x_px, dy = by_cell_[i].y_px - y_px;
        if (dx * dx + dy * dy < radius_px * radius_px) visit(by_cell_[i]);
      }
  }

  // All edge points in the order given to the constructor: tensors are made of them in this order.
  std::span<const EdgePoint> points() const { return points_; }
  // The same sorted by cell, in the order given within a cell.
  std::span<const EdgePoint> points_by_cell() const { return by_cell_; }

  static constexpr int MAX_RADIUS_PX = 8;

 private:
  // Lookups reach 2 to 3 px most of all. The points of neighbouring cells of a row lie one after
  // the other, so narrow cells cost nothing.
  static constexpr int CELL_WIDTH_PX = 2, CELL_HEIGHT_PX = 4;

  struct Cells {
    int x0, x1, y0, y1;
  };
  struct CellPoint {
    float x_px, y_px, nx, ny;  // place and normal
  };
  Cells cells_around(float x_px, float y_px, float radius_px) const;

  int columns_, rows_;
  std::vector<EdgePoint> points_, by_cell_;  // a copy each: lookups read neighbours in memory
  std::vector<CellPoint> cell_points_;       // as by_cell_
  // Points of cell c are by_cell_[cell_end_[c]] up to by_cell_[cell_end_[c + 1]].
  std::vector<std::uint32_t> cell_end_;
};

}  // namespace edgescout
