// How shading_sums.comp is called (shading_sums.h says what it computes).
//
// A workgroup sums over the map of one job. All jobs of a dispatch look at one view.
//
// Buffers: 0 depth maps, 1 maps (ShadingMap, by job), 2 image (four pixels a word), 3 depth map of
// known surfaces (any buffer where known_width is 0), 4 sums, SHADING_SUM_WORDS a job: system and
// right as floats, then pixels, grey and squares as numbers. right sums (grey -
// SHADING_MIDDLE_GREY) h: float loses less. The host adds the rest.
#ifndef EDGESCOUT_SHADING_SUMS_PUSH_H
#define EDGESCOUT_SHADING_SUMS_PUSH_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(SHADING_GROUP, 64);
EDGESCOUT_CONST(SHADING_MAP_PX, 96);
EDGESCOUT_CONST(SHADING_HARMONICS, 9);
EDGESCOUT_CONST(SHADING_SYSTEM, 45);  // upper triangle of 9 x 9
EDGESCOUT_CONST(SHADING_MIDDLE_GREY, 128);
EDGESCOUT_CONST(SHADING_FLOATS, 54);  // of the sums
EDGESCOUT_CONST(SHADING_SUM_WORDS, 57);
EDGESCOUT_CONST(SHADING_MAP_WORDS, 7);  // of ShadingMap

struct ShadingMap {
  int x_px;
  int y_px;
  uint stride_px;
  float fx;  // the map's camera
  float fy;
  float cx;
  float cy;
};

struct ShadingPush {
  uint width;  // of the image
  uint height;
  uint known_width;
  uint known_height;
  float known_fx;
  float known_fy;
  float known_cx;
  float known_cy;
  float tolerance_m;
  float max_bend;
  uint first_job;
  uint job_count;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
