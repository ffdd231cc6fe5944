// Probability that a registered pose is right: a logistic function of its features, fitted on rendered scenes (docs/evaluation.md says how).
#pragma once

#include "host/register/pose_features.h"

namespace edgescout {

double pose_probability(const PoseFeatures& features);

}  // namespace edgescout
