// Probability that a pose registered over several views is right.
#pragma once

#include <span>

#include "host/register/pose_features.h"

namespace edgescout {

// By Bayes' rule: each view multiplies the odds by what its own features say (detect/probability.h) beyond
// the base rate of right poses. A view may fail to see an instance that is there (hidden by others, say), so
// it speaks against it only so far; one that has less than 12 points or a fifth of the pose in its image says
// nothing. Of a single view that speaks: its pose_probability; of none: 0.
double probability_over_views(std::span<const PoseFeatures> by_view);

}  // namespace edgescout
