// How depth_raster.comp is called (depth_raster.h says what it computes).
//
// A workgroup takes DEPTH_GROUP triangles of one job: each invocation sets one up and fills it
// where its box is small; the large ones are filled by all together. The group's z is a band of
// rows, outside of which it fills nothing: lavapipe ends a shader's loops after 65,535 turns in
// all, and DEPTH_GROUP triangles as large as a band take a turn a pixel of it.
//
// A pixel's ray r = ((x - cx) / fx, (y - cy) / fy, 1) passes the triangle p0 p1 p2 where the three
// w_k = (p_i x (p_j - p_i)) . r have one sign; there z = sum w_k z_k / sum w_k. In camera
// coordinates a vertex far outside the image costs no precision, which projected ones would in
// float.
//
// Buffers: 0 vertices (3 floats each), 1 triangles (3 words each), 2 jobs (DepthJob), 3 depth,
// float bits as words, to be filled with DEPTH_EMPTY: positive floats are ordered as their bits
// are.
#ifndef EDGESCOUT_DEPTH_RASTER_PUSH_H
#define EDGESCOUT_DEPTH_RASTER_PUSH_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(DEPTH_GROUP, 64);
EDGESCOUT_CONST(DEPTH_JOB_WORDS, 16);
EDGESCOUT_CONST(DEPTH_SMALL_BOX, 32);       // pixels an invocation fills alone
EDGESCOUT_CONST(DEPTH_BAND_PIXELS, 65000);  // at most, unless a single row has more

struct DepthRasterPush {
  uint triangle_count;
  uint width;
  uint height;
  float near_m;
  uint band_rows;
  uint first_triangle;  // of this dispatch: a device takes so many groups along x
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
