// Probability that a reported pose is right: a logistic function of its features, times the
// fraction of it that is in the image and not behind known objects.
//
// Fitted on what is reported of rendered scenes (docs/evaluation.md says how). Poses are ranked by
// log_odds (register/pose_features.h) instead, which was fitted on all registered candidates beside
// them: among those that ranking has left, unexplained grey tells less.
#pragma once

#include "host/register/pose_features.h"

namespace edgescout {

double pose_probability(const PoseFeatures& features);

}  // namespace edgescout
