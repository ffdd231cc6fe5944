// How pose_normal_equations.comp and pose_score.comp are called (pose_normal_equations.h and
// pose_score.h say what they compute).
//
// A workgroup sums over the points part, part + parts, ... (in groups of POSE_GROUP) of one
// problem; the host adds the parts. All problems of a dispatch look at one view.
//
// Specialization constant 0: bands of the tensor. Buffers: 0..3 the tensor's bands, 4 model points
// (POSE_POINT_WORDS floats each), 5 problems (PoseProblem), 6 results [problem][part], and for
// pose_score 7: the image's gradient, a word a pixel (gx | gy << 16, doubled), or any buffer where
// has_gradient is 0. A result of pose_normal_equations is a NormalEquations; of pose_score
// POSE_SCORE_SUMS sums: of values, of direction agreements, of matched points, of points.
#ifndef EDGESCOUT_POSE_PUSH_H
#define EDGESCOUT_POSE_PUSH_H

#include "tensor_bands.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(POSE_GROUP, 64);
EDGESCOUT_CONST(POSE_POINT_WORDS, 6);
EDGESCOUT_CONST(POSE_PROBLEM_WORDS, 15);
EDGESCOUT_CONST(POSE_SYSTEM_SUMS, 32);
EDGESCOUT_CONST(POSE_SCORE_SUMS, 4);

struct PoseCamera {
  float fx;
  float fy;
  float cx;
  float cy;
  float min_depth_m;
};

struct PoseSystemPush {
  TensorGrid grid;
  PoseCamera camera;
  float min_foreshortening;
  uint first_problem;
  uint parts;
  uint loss;
  float scale_px;
};

struct PoseScorePush {
  TensorGrid grid;
  PoseCamera camera;
  uint first_problem;
  uint parts;
  uint has_gradient;
  float min_gradient;
  float match_px;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
