// The recursion over orientation and the smoothing over it, in place (Eqs. 5 and 6; dcd_tensor.h).
//
// One invocation does four neighbouring pixels (two words) at all bins. No value travels further
// than `reach` bins, where reach * step >= cap, so that going once round the circle from `reach`
// bins before its start gives the fixed point. The backward sweep feeds a window of 2 r + 1 values,
// from which the smoothed ones are written. Specialization constant 0: r, the radius of the
// smoothing, at most bins / 2 - 1 and DCD_SWEEP_MAX_RADIUS.
//
// Buffers: 0 tensor, a band of rows; 1 weights w_0..w_r, a word each.
#ifndef EDGESCOUT_DCD_SWEEP_H
#define EDGESCOUT_DCD_SWEEP_H

#include "tensor_layout.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(DCD_SWEEP_GROUP, 64);
EDGESCOUT_CONST(DCD_SWEEP_LANES, 8);        // invocations a tile
EDGESCOUT_CONST(DCD_SWEEP_MAX_RADIUS, 12);  // three standard deviations of the widest smoothing

struct DcdSweepPush {
  uint tile_count;  // of the band
  uint bins;
  uint step;   // 1/256 px between neighbouring bins
  uint cap;    // 1/256 px
  uint reach;  // bins
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
