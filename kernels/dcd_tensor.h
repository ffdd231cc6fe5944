// Edge points -> DCD tensor (paper, Sec. 3.3), the three kernels dcd_seed, distance_pass and
// dcd_sweep run after each other. Every path is exact with respect to the rounded definition below.
//
// An edge point seeds the pixel (round(x), round(y)) (half away from zero) of bin
// round(theta * bins / pi) mod bins; points outside the image or not finite are dropped. With S_k
// the seeds of bin k and the cap in whole 1/256 px:
//   D_k(x)  = min(cap, min_{s in S_k} round(256 * |x - s|))                    exact Euclidean
//   distance T_k(x)  = min_j (D_j(x) + round(256 * lambda * pi / bins) * |k - j|_bins)  circular
//   recursion, to the
//                                                                              fixed point (Eqs. 5,
//                                                                              6)
//   DT3_k   = (sum_d w_d T_{k+d}(x) + 2^14) >> 15                              circular Gaussian,
//   15-bit
// where |k - j|_bins = min(|k - j|, bins - |k - j|), all in units of 1/256 px. The weights w_d are
// the sampled Gaussian of `smoothing_variance` out to r = ceil(3 sigma), at most bins / 2 - 1,
// divided by their sum and rounded to 1/32768, the centre tap taking the remainder, so that they
// sum to exactly 32768.
//
// Agreement: reference, fast CPU path and Vulkan are equal bit for bit. Memory: 2 bytes a value;
// the fast path needs a list of the seeds beside it, no second tensor.
#pragma once

#include <span>
#include <vector>

#include "kernels/tensor_layout.h"
#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

// w_0..w_r, the one-sided half of the circular Gaussian over orientation; r < bins / 2.
std::vector<std::uint16_t> smoothing_weights(float variance_bins, int bins);
// Cost of one step between neighbouring bins, 1/256 px, saturating at 65535.
std::uint16_t orientation_step(const TensorOptions& options);
// Bin and pixel an edge point seeds; bin is -1 where the point lies outside the image.
struct Seed {
  int x, y, bin;
};
Seed seed_of(const EdgePoint& point, const TensorShape& shape);

// Plain and single-threaded: a two-pass exact distance transform a bin, then the recursion as
// printed.
std::vector<std::uint16_t> dcd_tensor_reference(std::span<const EdgePoint> edges, int width,
                                                int height, const TensorOptions& options);
// The same values, SIMD and threads, into `out` (TensorShape::size() values). Bands of rows are
// finished one by one while they sit in the second-level cache: every edge point stamps its disc of
// distances (radius: the cap) into the band, then the recursion runs over it.
void dcd_tensor_fast(std::span<const EdgePoint> edges, int width, int height,
                     const TensorOptions& options, ThreadPool& pool, std::span<std::uint16_t> out);

}  // namespace edgescout
