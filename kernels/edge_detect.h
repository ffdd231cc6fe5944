// Edges of a grey image as sub-pixel points with orientation: Gaussian derivative gradient,
// non-maximum suppression across the edge with a parabola for the sub-pixel offset, hysteresis over
// connected pixels, orientation read off a line that is fitted to the gradient's turn along the
// edge.
//
// The stages, their buffers and their arithmetic stand in edge_stages.h. Which pixels are edges is
// decided in integers, so:
//
// Agreement: every path gives the same pixels in the same order (row-major); x_px and y_px agree to
// 1e-3 px, theta_rad to 1e-3 rad (modulo pi), strength to 1e-5 relative.
//
// A pixel of the image's outermost ring is never an edge; x_px and y_px lie within half a pixel of
// the edge pixel in each axis.
#pragma once

#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

struct EdgeOptions {
  float sigma_px = 1.0f;  // of the Gaussian that is differentiated, [0.3, 8]
  float low_threshold =
      2.0f;  // gradient, grey levels a pixel, [0.1, 127]: a weaker pixel is no edge
  float high_threshold = 3.0f;  // [low_threshold, 127]: a chain needs one pixel of this strength
  int min_length_px = 8;  // [1, 10000]: chains (8-connected pixels) with fewer pixels are dropped
  void validate() const;  // throws InputError naming field and bound
};

// `image` has at least one pixel, else LogicError. Both validate the options.
std::vector<EdgePoint> detect_edges_reference(const ImageView& image, const EdgeOptions& options);
std::vector<EdgePoint> detect_edges_fast(const ImageView& image, const EdgeOptions& options,
                                         ThreadPool& pool);

}  // namespace edgescout
