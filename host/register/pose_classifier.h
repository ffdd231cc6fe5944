// Classifies poses as right or wrong by logistic functions of their features.
//
// scripts/fit_probability.py and scripts/fit_probability_over_views.py fit the weights on rendered
// scenes. pose_classifier_weights.h holds them and names data and commit. There are two fits for
// one view: `rank` on poses after the medium stage of detection, `probability` on those that
// detection reports without a threshold.
//
// Public header.
#pragma once

#include <span>

#include "host/register/pose_estimate.h"

namespace edgescout {

// How far psi lies above chance: its excess over CHANCE_PSI in units of its standard error. The
// error falls with the square root of the visible edge length. Psi alone prefers small, simple
// views: two parallel lines match anywhere. Of two poses of one object the z-score prefers the one
// that shows more edges. CHANCE_PSI lies a little above the psi of unrelated directions, a mean
// |cos| of 2 / pi.
inline constexpr double CHANCE_PSI = 0.65;
double psi_z_score(const PoseFeatures& features);

// Adds another view of the same pose.
void add(Shading& sum, const Shading& other);

// Returns the root mean square of the unexplained deviations divided by that of all deviations, in
// [0, 1]. 1 where too few pixels were compared. Near 1 where the contrast is as weak as the image's
// noise.
double unexplained_grey(const Shading& shading);

// Returns whether a view counts among several: it has 12 points and a fifth of the pose inside the
// image.
bool is_informative(const PoseFeatures& features);

// Pools the features of one pose over its views (at least one): means weighted by the views'
// numbers of points, sums of counts.
PoseFeatures pool_over_views(std::span<const PoseFeatures> by_view);

// Returns whether psi lies above chance in all views together, or clearly so in two of them: other
// objects may hide the pose from the rest.
bool has_psi_above_chance(std::span<const PoseFeatures> by_view);

struct PoseClassifier {
  // Returns the log-odds that registration can bring an aligned pose to a true one, from features
  // of one view or pooled ones. Without an image: minus the mean tensor value.
  static double rank(const PoseFeatures& features);
  // Returns the same from all views of a pose. Minus infinity where no view of several is
  // informative.
  static double rank(std::span<const PoseFeatures> by_view);

  // Returns the log-odds that a registered pose is right, from features of one view or pooled ones.
  // Without an image: minus the mean tensor value.
  static double log_odds(const PoseFeatures& features);

  // Returns the probability in [0, 1] that a registered pose is right, times the fraction of it
  // that is in the image and not behind known objects; 0 below 12 points.
  static double probability(const PoseFeatures& features);
  // Returns the same from all views of a pose. Its log-odds are linear in the mean over the
  // informative views of the log-probability in one view, which lies in [-10, 0]. So they are
  // bounded, a view that contradicts counts more than one that agrees, and the same views again add
  // nothing. Where a view has depth, its probability is that times the share of the measured
  // surface that nothing hides. One informative view: as above; none: 0.
  static double probability(std::span<const PoseFeatures> by_view);
};

// Sets PoseEstimate::classification from the features.
void classify(PoseEstimate& estimate);

}  // namespace edgescout
