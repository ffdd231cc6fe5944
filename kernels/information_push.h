// How information_rows.comp and information_columns.comp are called (mutual_information.h says what
// they compute).
//
// The first has a workgroup a particle and finds the logarithm of its likelihoods' sum, its
// *shift*. The second has an invocation a combination j: it finds p_j and its share sum_i w_i (L
// log (L / p) - L + p), every term of which is >= 0; the added terms cancel in the sum over
// particles. For the paper's own form all shifts are one number, the largest exponent there can be.
//
// Buffers: 0 sums, 1 counts (chamfer_push.h), 2 beliefs (InformationBelief), 3 shifts, a float a
// particle; of the second also 4 shares, a float a combination.
#ifndef EDGESCOUT_INFORMATION_PUSH_H
#define EDGESCOUT_INFORMATION_PUSH_H

#include "candidate_map.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(INFORMATION_GROUP, 64);
EDGESCOUT_CONST(INFORMATION_BELIEF_WORDS, 3);

struct InformationPush {
  uint particles;
  uint combinations;
  float cap_px;
  float inverse_scale;  // 1 / px^2
};
#ifdef __cplusplus
struct InformationBelief {
  float weight;
  float already_seen;
  float log_offset;  // log total, and Upsilon / s for the paper's own form
};
}  // namespace edgescout
#endif
#endif
