// Selects the edges that a scan of the whole image uses.
//
// A template at a wrong place finds edges by chance. The denser the edges, the more it finds: on
// texture it outscores the object. Therefore faint edges are left out, and each block of the image
// keeps its strongest edges up to a density at which chance matters little. Registration uses all
// edges again.
#pragma once

#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

struct SalientOptions {
  // Relative to the strength that 5 % of the edge points exceed, so independent of the exposure.
  double min_strength = 0.1;
  double max_density = 0.12;  // edge points per pixel of a block
  int block_px = 48;
};

// The order has no meaning.
std::vector<EdgePoint> salient_edges(std::span<const EdgePoint> edges, int width, int height,
                                     const SalientOptions& options = {});

}  // namespace edgescout
