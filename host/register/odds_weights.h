// The one form of both fits of scripts/fit_probability.py: log_odds (pose_features.h), which ranks,
// and pose_probability (detect/probability.h), which is reported.
#pragma once

#include "host/register/pose_features.h"

namespace edgescout {

struct OddsWeights {
  double bias, by_log_psi_z_score, by_mean_px, by_unexplained_grey;
};

double weighted_odds(const PoseFeatures& features, const OddsWeights& weights);

}  // namespace edgescout
