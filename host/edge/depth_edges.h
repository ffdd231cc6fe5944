// Compares the jumps of a depth image with the edges of the grey image that it came with: nearly
// all jumps are borders of objects, which the grey image shows as edges. Another frame's depth has
// them elsewhere, and that of a wrongly placed depth camera has them aside.
#pragma once

#include <cstddef>
#include <span>

#include "host/core/depth_image.h"
#include "kernels/types.h"

namespace edgescout {

enum class DepthFit {
  Unknown,    // too few jumps, or edges everywhere
  Fits,       //
  Moved,      // jumps lie on edges when the depth image is moved by dx_px, dy_px
  Elsewhere,  // nowhere near do they lie on edges more often than by chance
};

struct DepthEdges {
  DepthFit fit = DepthFit::Unknown;
  std::size_t jumps = 0;  // that were compared
  // Shares of the jumps with an edge within 2 px: in place, moved to where it is largest, and by
  // chance (the mean over the moves that are far from that).
  double in_place = 0, best = 0, by_chance = 0;
  int dx_px = 0, dy_px = 0;  // that move; along each axis up to 24 px
};

// `depth` belongs to the undistorted image, `edges` are that image's.
DepthEdges compare_depth_edges(const DepthImage& depth, const DepthNoise& noise,
                               std::span<const EdgePoint> edges);

}  // namespace edgescout
