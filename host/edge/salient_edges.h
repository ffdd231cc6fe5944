// The edges a scan of the whole image should look at.
//
// A template at a wrong place finds edges by chance, the more the denser they are: on texture it
// outscores the object. So faint edges are left out, and of every block of the image only the
// strongest stay, up to a density at which chance says little. Registration takes all edges again.
#pragma once

#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

struct SalientOptions {
  double min_strength =
      0.1;  // of the strength that 5 % of the edge points exceed: whatever the exposure
  double max_density = 0.12;  // edge points a pixel of a block
  int block_px = 48;
};

// In no particular order.
std::vector<EdgePoint> salient_edges(std::span<const EdgePoint> edges, int width, int height,
                                     const SalientOptions& options = {});

}  // namespace edgescout
