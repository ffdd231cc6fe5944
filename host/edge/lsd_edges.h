// Finds edges as line segments: LSD on a Gaussian pyramid, then each segment is sampled to edge
// points (paper, Sec. 3.3).
#pragma once

#include <vector>

#include "host/core/types.h"
#include "kernels/types.h"

namespace edgescout {

struct LsdOptions {
  int levels = 2;         // of the pyramid, [1, 6]; levels smaller than 16 px are left out
  void validate() const;  // InputError naming the field and the violated bound
};

// One point per pixel along each segment, with the segment's orientation. Its strength is the image
// gradient there (central differences). The finest level comes first. A coarser level is mapped
// back to the image and adds points only where no finer level has an edge of similar orientation
// (15 degrees) within 2 px, because blur displaces edges. Points lie inside the image.
std::vector<EdgePoint> lsd_edges(const Image& image, const LsdOptions& options);

}  // namespace edgescout
