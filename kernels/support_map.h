// Where in an image an edge of which direction has support: a word a pixel, a bit an orientation.
//
// A predicted edge is supported where the image's gradient has a local maximum near by, across the
// edge and of like direction. The kernel edge_support asks that of many points; this map answers it
// beforehand for every pixel and SUPPORT_BINS directions of the edge's normal.
//
// With n_b = (cos, sin)(pi b / SUPPORT_BINS), the gradient g of edge_gradient at SUPPORT_SIGMA_PX
// and the candidates of edge_thin at SUPPORT_MIN_GRADIENT (edge_stages.h):
//   directions(q) = bits b where g(q) and n_b, modulo pi, differ by at most SUPPORT_MAX_TURN_DEG;
//                   0 where q is no candidate
//   reach(d)      = bits b with |d . n_b| <= SUPPORT_ALONG_PX and |d x n_b| <= SUPPORT_BESIDE_PX
//   map(p)        = OR of directions(p + d) & reach(d) over the offsets d of a window,
//                   |dx|, |dy| <= SUPPORT_WINDOW, that lie in the image
// The turn is decided in integers: with lo_b and hi_b the directions SUPPORT_MAX_TURN_DEG below and
// above that of n_b, each rounded to 1 / 2^14,
//   (lo_b x g >= 0 and g x hi_b >= 0) or (lo_b x g <= 0 and g x hi_b <= 0).
//
// Agreement: equal on every path, bit for bit.
#ifndef EDGESCOUT_SUPPORT_MAP_H
#define EDGESCOUT_SUPPORT_MAP_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(SUPPORT_BINS, 32);
EDGESCOUT_CONST(SUPPORT_WINDOW, 2);  // px
#ifdef __cplusplus
}  // namespace edgescout

#include <array>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

inline constexpr float SUPPORT_SIGMA_PX = 1.0f;      // that of the edge detector
inline constexpr float SUPPORT_MIN_GRADIENT = 3.0f;  // grey levels a pixel
inline constexpr double SUPPORT_MAX_TURN_DEG = 20;
// Two pixels, and what reaches the pixel (2, 1) along a normal between the axes.
inline constexpr double SUPPORT_ALONG_PX = 2.25;
// Half a diagonal: no thin chain of pixels slips through between two offsets.
inline constexpr double SUPPORT_BESIDE_PX = 0.75;

// The constants of the definition as the paths read them.
struct SupportTables {
  struct Cone {
    std::int32_t lo_x, lo_y, hi_x, hi_y;  // 1 / 2^14
  };
  std::array<Cone, SUPPORT_BINS> cones;
  std::array<std::uint32_t, (2 * SUPPORT_WINDOW + 1) * (2 * SUPPORT_WINDOW + 1)>
      reach;  // row-major
};
const SupportTables& support_tables();
// directions(q) of a candidate with this gradient.
std::uint32_t support_directions(int gx, int gy);

// Row-major, width * height words. LogicError: an image without pixels.
std::vector<std::uint32_t> support_map_reference(const ImageView& image);
std::vector<std::uint32_t> support_map_fast(const ImageView& image, ThreadPool& pool);

}  // namespace edgescout
#endif
#endif
