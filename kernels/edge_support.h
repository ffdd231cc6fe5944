// How well an image's edges support many poses, against what chance gives at the same place.
//
// A point of a predicted edge is supported where the view's support map (support_map.h) has the bit
// of the edge's normal at the point's pixel. Its chance is how often it is supported in the
// SUPPORT_COPIES copies of the pose that are displaced by 7 and 14 px, each in 8 directions
// (rounded to whole pixels, support_displacements). Textured surroundings support any pose; there
// the chance is high, and support says little.
//
// Per problem, over its points, with s_k = 1 where copy k is supported (k = 0: the pose itself; a
// copy outside the image is not), c = sum of s_k over k = 1..SUPPORT_COPIES:
//   p0 = c / SUPPORT_COPIES, at least SUPPORT_MIN_CHANCE, at most p1
//   p1 = SUPPORT_ON_SILHOUETTE or, inside it, SUPPORT_INSIDE: how often a right pose is supported
//   l  = s_0 log(p1 / p0) + (1 - s_0) log((1 - p1) / (1 - p0))             rounded to 1/64 nat
// and with the points' weights w (independent observations, 1 / SUPPORT_WEIGHT_ONE):
//   L_j = sum of w l over the silhouette's points (j < SUPPORT_SECTORS: their sector) and the
//         interior ones (j - SUPPORT_SECTORS: their sector)
//   S_k = sum of w s_k,   W = sum of w
// A sector may be hidden by something unknown, at a price: v of the sectors are visible, so
//   m(L) = sum over the sectors of log(v e^L + 1 - v),   v = SUPPORT_VISIBLE.
//   log_ratio          = m of L_j + L_(j + SUPPORT_SECTORS)
//   interior_log_ratio = m of the interior L alone
//   support            = S_0 / W
//   best_displaced     = max over k >= 1 of S_k / W
// All are 0 without points and in a view without an image.
//
// Agreement: equal on every path, bit for bit. Sums are integers; one function of the host makes
// the rest of them.
#ifndef EDGESCOUT_EDGE_SUPPORT_H
#define EDGESCOUT_EDGE_SUPPORT_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(SUPPORT_COPIES, 16);
EDGESCOUT_CONST(SUPPORT_SECTORS, 12);
EDGESCOUT_CONST(SUPPORT_PARTS, 24);  // sectors of the silhouette, then those of the interior
EDGESCOUT_CONST(SUPPORT_WEIGHT_ONE, 1024);
EDGESCOUT_CONST(SUPPORT_MAX_WEIGHT, 0x800000);  // of all points of a problem: sums fit 32 bits
#ifdef __cplusplus
}  // namespace edgescout

#include <array>
#include <span>

#include "kernels/support_map.h"
#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

inline constexpr double SUPPORT_MIN_CHANCE = 1.0 / 32;
inline constexpr double SUPPORT_ON_SILHOUETTE = 0.85;
inline constexpr double SUPPORT_INSIDE = 0.7;
inline constexpr double SUPPORT_VISIBLE = 0.8;

// A model point that is visible, in the image. Two words; a shader reads them so.
struct SupportPoint {
  std::uint16_t x_px, y_px;  // its pixel
  std::uint16_t weight;      // 1 / SUPPORT_WEIGHT_ONE of an independent observation
  std::uint8_t bin;          // of the normal, below SUPPORT_BINS (support_map.h)
  std::uint8_t part;         // sector about the object's centre, + SUPPORT_SECTORS in the interior
};

struct SupportProblem {
  std::uint32_t first_point;  // into the list of all problems' points
  std::uint32_t point_count;
  std::uint32_t view;
};

struct EdgeSupport {
  float log_ratio = 0;           // nats, all edges
  float interior_log_ratio = 0;  // nats, edges inside the silhouette
  float support = 0;             // weighted fraction of the points, [0, 1]
  float best_displaced = 0;      // the same of the best displaced copy
};

// A view's support map; no words: a view without an image.
struct SupportView {
  std::span<const std::uint32_t> map;
  int width, height;
};

// The constants of the definition as the paths read them.
struct SupportDisplacement {
  std::int32_t x_px, y_px;
};
const std::array<SupportDisplacement, SUPPORT_COPIES>& support_displacements();
// 64 l by [interior][s_0][c].
using SupportLogRatios = std::array<std::array<std::array<std::int32_t, SUPPORT_COPIES + 1>, 2>, 2>;
const SupportLogRatios& support_log_ratios();

struct SupportSums {
  std::array<std::int32_t, SUPPORT_PARTS> log_ratios{};       // 64 L
  std::array<std::uint32_t, SUPPORT_COPIES + 1> supported{};  // S
  std::uint32_t weight = 0;                                   // W
};
EdgeSupport to_edge_support(const SupportSums& sums);

// LogicError: points beyond the list, of no such view, outside the image, with no such bin or part,
// or weights of a problem that add up to more than SUPPORT_MAX_WEIGHT.
void check_edge_support(std::span<const SupportView> views, std::span<const SupportPoint> points,
                        std::span<const SupportProblem> problems, std::size_t results);

void edge_support_reference(std::span<const SupportView> views,
                            std::span<const SupportPoint> points,
                            std::span<const SupportProblem> problems, std::span<EdgeSupport> out);
void edge_support_fast(std::span<const SupportView> views, std::span<const SupportPoint> points,
                       std::span<const SupportProblem> problems, std::span<EdgeSupport> out,
                       ThreadPool& pool);

}  // namespace edgescout
#endif
#endif
