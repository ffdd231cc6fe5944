// Probability that a pose registered over several views is right.
#pragma once

#include <span>
#include <vector>

#include "host/register/pose_features.h"

namespace edgescout {

// Each view adds to the log-odds what its features say (evidence, evidence over what agrees beside
// the pose, unexplained grey), and what n of them say together counts a square root of n less, as
// for means of n errors that are not independent: views share the neighbours, the shadows and the
// wrong edges that a pose was pulled to. More than five count as five that say the same in the
// mean. A view may fail to see an instance that is there (hidden by others, say), so it speaks
// against it only so far; one that has less than 12 points or a fifth of the pose in its image says
// nothing. Of a single view that speaks: its pose_probability (detect/probability.h); of none: 0.
//
// Fitted on candidates of rendered bins that do not reach into a better one (docs/evaluation.md
// says how): that two things cannot stand in one place is left to exclusive_probabilities
// (plausible_pairs.h).
double probability_over_views(std::span<const PoseFeatures> by_view);

// What it is a function of: sums over the views that speak.
struct SeveralViews {
  int views = 0;
  double log_psi_z_score = 0;  // logarithms, of two standard errors at least
  double log_background_psi_z_score = 0;
  double unexplained_grey = 0;
};
SeveralViews sum_of_speaking(std::span<const PoseFeatures> by_view);

// Log-odds by which candidates are ranked and chosen: of probability_over_views; where there is but
// one view log_odds (register/pose_features.h). Minus infinity where no view of several speaks.
double merit(std::span<const PoseFeatures> by_view);

// probability_over_views of every pose; of those that several views speak of, what is left where
// they reach further than `penetration_m` into more probable ones (exclusive_probabilities,
// plausible_pairs.h). One view says too little of how far away a pose is.
std::vector<double> probabilities_without_collisions(
    std::span<const EdgeModel> models, std::span<const ObjectPose> poses,
    std::span<const std::vector<PoseFeatures>> by_view, double penetration_m, ThreadPool& pool);

}  // namespace edgescout
