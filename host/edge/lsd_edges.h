// Edges as line segments: LSD on a Gaussian pyramid, every segment drawn into edge points (paper,
// Sec. 3.3).
#pragma once

#include <vector>

#include "host/core/types.h"
#include "kernels/types.h"

namespace edgescout {

struct LsdOptions {
  int levels = 2;         // of the pyramid, [1, 6]; levels smaller than 16 px are left out
  void validate() const;  // throws InputError naming field and bound
};

// One point a pixel along each segment, with the segment's orientation; strength is the image's
// gradient there (central differences). The finest level comes first; a coarser one, mapped back to
// the image, adds points only where no finer level has an edge of similar orientation (15 degrees)
// within 2 px: blurring displaces edges. Points lie inside the image.
std::vector<EdgePoint> lsd_edges(const Image& image, const LsdOptions& options);

}  // namespace edgescout
