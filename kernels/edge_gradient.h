// How edge_gradient.comp is called (edge_stages.h says what it computes).
//
// One invocation a pixel; specialization constant 0 is the pass: EDGE_ROWS leaves S and D,
// EDGE_COLUMNS the gradient. Pairs of 16-bit values share a word, the first in the low half: S | D
// << 16, gx | gy << 16.
//
// Buffers: 0 image (4 pixels a word, row-major without padding), 1 weights (EDGE_MAX_RADIUS + 1 of
// the Gaussian, then as many of its derivative), 2 rows (a word a pixel), 3 gradient (a word a
// pixel).
#ifndef EDGESCOUT_EDGE_GRADIENT_H
#define EDGESCOUT_EDGE_GRADIENT_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(EDGE_GROUP, 64);  // of all edge_* shaders
EDGESCOUT_CONST(EDGE_ROWS, 0);
EDGESCOUT_CONST(EDGE_COLUMNS, 1);

struct EdgeGradientPush {
  uint width;
  uint height;
  uint radius;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
