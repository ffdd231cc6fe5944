#include "host/register/contested_edges.h"

#include <limits>

namespace edgescout {

namespace {

// Points of one line differ by less: they lie beside edge points at distances across the edge.
constexpr float SAME_LINE_PX = 0.3f;
// Along the edge: model and edge points lie about a pixel apart. Edges that are nearer to each
// other than this are rarely told apart by the detector.
constexpr float STRETCH_PX = 1.5f;

constexpr float NOT_TAKEN = std::numeric_limits<float>::infinity();

}  // namespace

ContestedEdges::ContestedEdges(const EdgeIndex& edges)
    : edges_(edges), least_px_(edges.points_by_cell().size(), NOT_TAKEN) {}

std::size_t ContestedEdges::index_of(const EdgePoint& edge) const {
  return std::size_t(&edge - edges_.points_by_cell().data());
}

void ContestedEdges::take(const EdgePoint& edge, double distance_px) {
  float& least = least_px_[index_of(edge)];
  if (least == NOT_TAKEN) taken_.push_back(index_of(edge));
  least = std::min(least, float(distance_px));
}

bool ContestedEdges::is_lost(const EdgePoint& edge, double distance_px) const {
  if (float(distance_px) <= SAME_LINE_PX) return false;  // no distance is negative
  float least = NOT_TAKEN;
  edges_.for_each_near(edge.x_px, edge.y_px, STRETCH_PX, [&](const EdgePoint& near) {
    least = std::min(least, least_px_[index_of(near)]);
  });
  return float(distance_px) > least + SAME_LINE_PX;
}

void ContestedEdges::clear() {
  for (const std::size_t i : taken_) least_px_[i] = NOT_TAKEN;
  taken_.clear();
}

}  // namespace edgescout
