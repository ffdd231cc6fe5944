// How edge_link.comp is called (edge_stages.h says what it computes).
//
// Connected components by union-find; specialization constant 0 is the pass:
//
// EDGE_LINK_MERGE, a pixel each: joins it with its neighbours before it. Roots are the smallest
// index of a component.
//
// EDGE_LINK_COUNT, a pixel each: counts it at its root and notes there whether it is strong.
//
// EDGE_LINK_KEEP, a pixel each: appends the index of a kept pixel to the list, in no order.
//
// EDGE_LINK_POINT, a kept pixel each: its EdgePoint. `count` is the number of kept pixels, in the
// other passes of all pixels.
//
// Buffers: 0 gradient, 1 labels, 2 components (a word a pixel, zeroed: pixels | EDGE_STRONG), 3
// kept (word 0, zeroed: how many; then their indices), 4 points (EdgePoint).
#ifndef EDGESCOUT_EDGE_LINK_H
#define EDGESCOUT_EDGE_LINK_H

#include "edge_thin.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(EDGE_LINK_MERGE, 0);
EDGESCOUT_CONST(EDGE_LINK_COUNT, 1);
EDGESCOUT_CONST(EDGE_LINK_KEEP, 2);
EDGESCOUT_CONST(EDGE_LINK_POINT, 3);
EDGESCOUT_CONST(EDGE_STRONG, 0x80000000);

struct EdgeLinkPush {
  uint width;
  uint height;
  uint high2;  // squared threshold, gradient units
  uint min_length_px;
  uint count;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
