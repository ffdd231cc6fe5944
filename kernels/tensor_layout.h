// The Directional Chamfer Distance tensor's storage, the same on every path.
//
// Values are unsigned 16-bit fixed point, DCD_UNITS_PER_PX to a pixel, saturating at the cap (an
// option, at most 255 px). Bin k covers the orientations [k - 1/2, k + 1/2) * pi / bins, so bin 0
// wraps.
//
// Order: rows are cut into tiles of DCD_TILE pixels (the last one padded); within a tile the bins
// follow each other, and within a bin the tile's pixels:
//   index(x, y, k) = ((y * tiles_per_row + x / DCD_TILE) * bins + k) * DCD_TILE + x % DCD_TILE
// A tile of one bin is 64 bytes, one cache line and one 512-bit vector; the recursion over
// orientation works inside a tile and never leaves the first-level cache. Padding pixels hold the
// cap.
#ifndef EDGESCOUT_TENSOR_LAYOUT_H
#define EDGESCOUT_TENSOR_LAYOUT_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(DCD_TILE, 32);
EDGESCOUT_CONST(DCD_UNITS_PER_PX, 256);
EDGESCOUT_CONST(DCD_MAX_BINS, 128);
EDGESCOUT_CONST(DCD_MAX_CAP_PX, 255);
#ifdef __cplusplus
}  // namespace edgescout

#include <cstddef>

namespace edgescout {

// Sampling of the tensor and the parameters of its metric (paper, Eqs. 4-6).
struct TensorOptions {
  int bins = 60;  // orientations over pi; even, in [4, 128]
  float lambda_px_per_rad =
      30.0f;  // weight of orientation against location (paper: 100; docs/evaluation.md)
  float smoothing_variance = 1.0f;  // of the circular Gaussian over orientation, bins^2; 0: none
  float cap_px = 60.0f;             // no value is larger, in (0, 255]
  // Throws InputError naming the field and the violated bound.
  void validate() const;
};

struct TensorShape {
  int width = 0;
  int height = 0;
  int bins = 0;
  int tiles_per_row() const { return (width + int(DCD_TILE) - 1) / int(DCD_TILE); }
  std::size_t index(int x, int y, int bin) const {
    return ((static_cast<std::size_t>(y) * tiles_per_row() + x / int(DCD_TILE)) * bins + bin) *
               DCD_TILE +
           x % int(DCD_TILE);
  }
  std::size_t size() const {
    return static_cast<std::size_t>(height) * tiles_per_row() * bins * DCD_TILE;
  }
  bool operator==(const TensorShape&) const = default;
};

}  // namespace edgescout
#endif
#endif
