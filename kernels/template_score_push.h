// How template_score.comp is called (template_score.h says what it computes).
//
// One workgroup a job. Its invocations share out the job's anchors; where there are fewer anchors
// than invocations, several take a part of the points of one anchor each.
//
// Specialization constant 0: bands of the tensor. Buffers: 0..3 the tensor's bands, 4 points
// (TemplatePoint), 5 jobs (TemplateJob), 6 hits (TemplateHit).
#ifndef EDGESCOUT_TEMPLATE_SCORE_PUSH_H
#define EDGESCOUT_TEMPLATE_SCORE_PUSH_H

#include "tensor_bands.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(TEMPLATE_SCORE_GROUP, 64);
EDGESCOUT_CONST(TEMPLATE_POINT_WORDS, 2);
EDGESCOUT_CONST(TEMPLATE_JOB_WORDS, 6);
EDGESCOUT_CONST(TEMPLATE_HIT_WORDS, 3);

struct TemplateScorePush {
  TensorGrid grid;
  uint job_count;
  uint anchor_step;
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
