// For every pixel its nearest edge point: the undirected distance transform with its labels.
#pragma once

#include <span>
#include <vector>

#include "host/baselines/scalar_image.h"
#include "kernels/types.h"

namespace edgescout {

// Exact between pixels: an edge point stands for the pixel it seeds (dcd_tensor.h). Points outside
// the image are left out; where several seed one pixel the first stays.
struct NearestEdges {
  int width = 0;
  int height = 0;
  std::vector<std::int32_t>
      index;  // row-major, into the edge points; all -1 where the image has none
};
NearestEdges nearest_edges(std::span<const EdgePoint> edges, int width, int height);

// Distance from every pixel to that of its nearest edge point; `far_px` everywhere where there is
// none.
ScalarImage distance_image(const NearestEdges& nearest, std::span<const EdgePoint> edges,
                           float far_px);

}  // namespace edgescout
