// The nearest edge point of every pixel: the undirected distance transform with its labels.
#pragma once

#include <span>
#include <vector>

#include "host/baselines/scalar_image.h"
#include "kernels/types.h"

namespace edgescout {

// Exact between pixels: an edge point stands for the pixel that it seeds (dcd_tensor.h). Points
// outside the image are left out. Where several points seed one pixel, the first one counts.
struct NearestEdges {
  int width = 0;
  int height = 0;
  // Row-major, into the edge points; all -1 where the image has none.
  std::vector<std::int32_t> index;
};
NearestEdges nearest_edges(std::span<const EdgePoint> edges, int width, int height);

// Distance from every pixel to the pixel of its nearest edge point. `far_px` everywhere if there is
// no edge point.
ScalarImage distance_image(const NearestEdges& nearest, std::span<const EdgePoint> edges,
                           float far_px);

}  // namespace edgescout
