// How edge_support.comp is called (edge_support.h says what it computes).
//
// A workgroup sums over the points of one problem. All problems of a dispatch look at one view.
//
// Buffers: 0 support map (a word a pixel), 1 points (x | y << 16, weight | bin << 16 | part << 24),
// 2 problems (SupportProblem), 3 displacements and log ratios (SUPPORT_COPIES pairs, then
// [interior][s_0][c]), 4 sums (SupportSums, word by word).
#ifndef EDGESCOUT_EDGE_SUPPORT_PUSH_H
#define EDGESCOUT_EDGE_SUPPORT_PUSH_H

#include "edge_support.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(EDGE_SUPPORT_GROUP, 64);
EDGESCOUT_CONST(SUPPORT_POINT_WORDS, 2);
EDGESCOUT_CONST(SUPPORT_PROBLEM_WORDS, 3);
EDGESCOUT_CONST(SUPPORT_SUM_WORDS, 42);  // of SupportSums

struct EdgeSupportPush {
  uint width;
  uint height;
  uint first_problem;
  uint problem_count;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
