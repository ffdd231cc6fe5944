// How pose_depth.comp is called (pose_depth.h says what it computes).
//
// Workgroups, parts and problems are those of pose_push.h. Buffers: 0 surface points
// (POSE_POINT_WORDS floats each), 1 problems (PoseProblem), 2 results [problem][part] of
// POSE_DEPTH_SUMS floats (a PoseDepth), 3 the view's depth, row by row.
#ifndef EDGESCOUT_POSE_DEPTH_PUSH_H
#define EDGESCOUT_POSE_DEPTH_PUSH_H

#include "pose_push.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(POSE_DEPTH_SUMS, 34);

struct PoseDepthPush {
  PoseCamera camera;
  uint width;
  uint height;
  uint first_problem;
  uint parts;
  float min_facing;
  float band_sigmas;
  float noise_floor_m;
  float noise_per_m;
  float surface_m;
  float band_m;
  float loss_scale;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
