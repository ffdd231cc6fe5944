// Probability that a registered pose is right: the logistic function of its log-odds (register/pose_features.h), less for poses partly outside the image.
#pragma once

#include "host/register/pose_features.h"

namespace edgescout {

double pose_probability(const PoseFeatures& features);

}  // namespace edgescout
