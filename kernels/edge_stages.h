// The four stages of the edge detector, for those who implement them: reference, fast CPU path,
// shaders.
//
// Planes are row-major, width * height. I(x, y) outside the image is the nearest pixel of its
// border. Points come in the order of their pixels, row-major.
//
// clang-format off
//
// edge_gradient: uint8 plane -> int16 pairs (gx, gy), units of 1/128 grey level a pixel, exact integers.
// With the weights s_i, d_i of edge_weights(), |i| <= radius; >> rounds down:
//   S(x, y)  = (sum_i s_|i| I(x + i, y) + 64) >> 7                     smoothed along the row
//   D(x, y)  = (sum_{i>0} d_i (I(x + i, y) - I(x - i, y)) + 64) >> 7   differentiated along the row
//   gx(x, y) = (sum_i s_|i| D(x, y + i) + 8192) >> 14
//   gy(x, y) = (sum_{i>0} d_i (S(x, y + i) - S(x, y - i)) + 8192) >> 14
// S and D of a row outside the image are those of the border's row. S, D, gx, gy fit int16, sums int32.
//
// edge_thin: gradient -> uint8 plane, 1 where the pixel is an edge candidate. With
//   M2 = gx^2 + gy^2,   m = max(|gx|, |gy|),   n = min(|gx|, |gy|),
//   sx, sy = signs of gx, gy (-1 or +1; +1 for zero),
//   (ax, ay) = (sx, 0) if |gx| >= |gy|, else (0, sy),
//   f = (256 n + m / 2) / m                                            integer division
//   ring(k) = (256 - f) (M2(x + k ax, y + k ay) >> 6) + f (M2(x + k sx, y + k sy) >> 6)      in uint32
// a candidate lies inside the outermost ring of the image and has
//   M2 >= edge_threshold(low_threshold)^2,
//   256 (M2 >> 6) > ring(-1)   and   256 (M2 >> 6) >= ring(+1).
//
// edge_link: candidates -> those kept: the 8-connected components with at least min_length_px pixels, one
// of which has M2 >= edge_threshold(high_threshold)^2.
//
// edge_point: one kept pixel -> EdgePoint, in float; M = sqrt(M2), strength = M / 128.
//   Position: the top of the parabola through the logarithms across the edge (exact for the Gaussian
//   profile of a blurred step; the bound keeps plateaus from dividing by nothing). With r = n / m,
//     A(k) = max(1, (1 - r) M(x + k ax, y + k ay) + r M(x + k sx, y + k sy)),
//     p = log(A(-1) / M),   q = log(A(+1) / M),
//     t = (p - q) / (2 min(p + q, -1/256)), clamped to [-1/2, 1/2],
//     position = (x, y) + t (sx, r sy) if |gx| >= |gy|, else (x, y) + t (r sx, sy).
//   Orientation: the turn of the gradient against the distance along the edge, a weighted line read off at
//   the pixel itself (a mean alone would lean on curved edges, where pixels lie unevenly). Over the
//   *candidates* q at offsets |dx|, |dy| <= EDGE_WINDOW, the pixel itself included, with N = g / |g|,
//     u = dy Nx - dx Ny (along),   v = dx Nx + dy Ny (across),
//     c = N . g_q / |g_q|          (those with c <= 0 stay out),
//     s = (Nx gy_q - Ny gx_q) / |g_q|,   a = s (1 + s^2 / 6)            the turn, about asin(s)
//     w = (1 - u^2 / EDGE_REACH_ALONG^2)_+^2 (1 - v^2 / EDGE_REACH_ACROSS^2)_+^2 c^8 |g_q|^2,
//     W, U, UU, A, UA = sum w (1, u, u^2, a, u a),
//     k = (W UA - U A) / (W UU - U^2 + W^2 / 2)                        half a pixel^2 tames short chains
//     theta = atan2(gy, gx) + pi / 2 + (A - k U) / W, modulo pi into [0, pi).
//
// clang-format on
#ifndef EDGESCOUT_EDGE_STAGES_H
#define EDGESCOUT_EDGE_STAGES_H

#include "kernels/interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(EDGE_GRADIENT_SCALE, 128);  // units of the gradient in a grey level a pixel
EDGESCOUT_CONST(EDGE_MAX_RADIUS, 24);
EDGESCOUT_CONST(EDGE_WINDOW, 4);       // half the window of the line that gives the orientation, px
EDGESCOUT_CONST(EDGE_REACH_ALONG, 5);  // px
EDGESCOUT_CONST(EDGE_REACH_ACROSS, 2);  // px
#ifdef __cplusplus
}
#endif

#ifdef __cplusplus
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/edge_detect.h"
#include "kernels/unfilled.h"

namespace edgescout {

// Half kernels, units of 1/16384: the Gaussian (sums to 16384 over both sides) and its derivative
// (answers a ramp of slope one with 16384).
struct EdgeWeights {
  int radius = 0;  // ceil(3 sigma), at most EDGE_MAX_RADIUS
  std::array<std::int32_t, EDGE_MAX_RADIUS + 1> smooth{};
  std::array<std::int32_t, EDGE_MAX_RADIUS + 1> derivative{};  // [0] is 0
};
EdgeWeights edge_weights(float sigma_px);
// Grey levels a pixel -> gradient units, rounded, at least 1.
std::int32_t edge_threshold(float grey_levels_per_px);

// One kept pixel: its place and its squared gradient.
struct EdgePixel {
  std::int32_t x, y;
  std::uint32_t m2;
};

// The parts of the fast path. Planes of gx and gy; candidates as bytes of 0 and 1 with a margin of
// EDGE_WINDOW pixels on all sides.
struct EdgePlanes {
  int width = 0, height = 0;
  Unfilled<std::int16_t> gx, gy;
  std::vector<std::uint8_t> candidates;
  EdgePlanes(int image_width, int image_height);
  std::size_t stride() const { return std::size_t(width) + 2 * EDGE_WINDOW; }
  std::size_t candidate_index(int x, int y) const {
    return std::size_t(y + EDGE_WINDOW) * stride() + x + EDGE_WINDOW;
  }
};
void edge_gradient_fast(const ImageView& image, const EdgeWeights& weights, ThreadPool& pool,
                        EdgePlanes& planes);
// Marks the candidates and lists them, row-major.
std::vector<EdgePixel> edge_thin_fast(std::int32_t low, ThreadPool& pool, EdgePlanes& planes);
// Drops what hysteresis drops, in place.
void edge_link_fast(std::int32_t high, int min_length_px, std::vector<EdgePixel>& pixels);
EdgePoint edge_point_fast(const EdgePlanes& planes, const EdgePixel& pixel);

// The stages of the reference, one by one.
std::vector<std::int16_t> edge_gradient_reference(const ImageView& image,
                                                  const EdgeWeights& weights);
std::vector<std::uint8_t> edge_thin_reference(std::span<const std::int16_t> gradient, int width,
                                              int height, std::int32_t low);
std::vector<std::uint8_t> edge_link_reference(std::span<const std::int16_t> gradient,
                                              std::span<const std::uint8_t> candidates, int width,
                                              int height, std::int32_t high, int min_length_px);
EdgePoint edge_point_reference(std::span<const std::int16_t> gradient,
                               std::span<const std::uint8_t> candidates, int width, int height,
                               int x, int y);

}  // namespace edgescout
#endif
#endif
