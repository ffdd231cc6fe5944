// Edges of a grey image as sub-pixel points with orientation: Gaussian derivative gradient, non-maximum suppression across the
// edge with a parabola for the sub-pixel offset, hysteresis. Three kernels: edge_gradient, edge_thin, edge_link.
#pragma once

#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

struct EdgeOptions {
  float sigma_px = 1.0f;         // of the Gaussian before differentiation, (0, 8]
  float low_threshold = 2.0f;    // gradient magnitude, grey levels a pixel: a weaker pixel is no edge
  float high_threshold = 5.0f;   // a chain needs one pixel of this strength
  int min_length_px = 8;         // shorter chains are dropped (8-connected pixels)
  void validate() const;         // throws InputError naming field and bound
};

std::vector<EdgePoint> detect_edges_reference(const ImageView& image, const EdgeOptions& options);
std::vector<EdgePoint> detect_edges_fast(const ImageView& image, const EdgeOptions& options, ThreadPool& pool);

}  // namespace edgescout
