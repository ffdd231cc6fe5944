// Decides which points of a model keep the edges of the image that they have taken.
//
// Model lines that lie side by side, such as the two borders of a thin face, take the same edge of
// the image where the other one's edge does not show. Both then pull the pose, and it ends between
// them. An edge of the image shows one line of the model: the nearest.
#pragma once

#include <vector>

#include "host/edge/edge_index.h"

namespace edgescout {

// Of one image and one pose.
class ContestedEdges {
 public:
  // `edges` must live longer.
  explicit ContestedEdges(const EdgeIndex& edges);

  // A model point takes an edge point, at this distance across the edge.
  void take(const EdgePoint& edge, double distance_px);

  // Whether the model point that took it lies further off by more than 0.3 px than another that
  // took the same stretch of the edge, 1.5 px to each side.
  bool is_lost(const EdgePoint& edge, double distance_px) const;

  void clear();

 private:
  std::size_t index_of(const EdgePoint& edge) const;

  const EdgeIndex& edges_;
  std::vector<float> least_px_;  // by edge point, in the order of points_by_cell()
  std::vector<std::size_t> taken_;
};

}  // namespace edgescout
