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

// The same with background_psi in place of chance. The parallel lines of a barcode agree with an
// object at any place; blank surroundings agree with none.
double background_psi_z_score(const PoseFeatures& features);

// Adds another view of the same pose.
void add(Shading& sum, const Shading& other);

// Root mean square of the unexplained deviations divided by that of all deviations, in [0, 1]. 1
// where too few pixels were compared. Near 1 where the contrast is as weak as the image's noise.
double unexplained_grey(const Shading& shading);

// Pools the features of one pose over its views (at least one): means weighted by the views'
// numbers of points, sums of counts.
PoseFeatures pool_over_views(std::span<const PoseFeatures> by_view);

struct PoseClassifier {
  // Log-odds that registration can bring an aligned pose to a true one, from features of one view
  // or pooled ones. Without an image: minus the mean tensor value.
  static double rank(const PoseFeatures& features);
  // The same from all views of a pose. Minus infinity where no view of several is informative.
  static double rank(std::span<const PoseFeatures> by_view);

  // Log-odds that a registered pose is right, from features of one view or pooled ones. Without an
  // image: minus the mean tensor value.
  static double log_odds(const PoseFeatures& features);

  // Probability in [0, 1] that a registered pose is right, times the fraction of it that is in the
  // image and not behind known objects; 0 below 12 points.
  static double probability(const PoseFeatures& features);
  // The same from all views of a pose. Each informative view adds its log-odds; the sum of n views
  // counts a square root of n less, as for a mean of n dependent errors: views share neighbours,
  // shadows and wrong edges. More than five views count as five. A view with less than 12 points or
  // a fifth of the pose inside the image is not informative. One informative view: as above; none:
  // 0.
  static double probability(std::span<const PoseFeatures> by_view);
};

// Sums over the informative views. The probability over several views is a function of them.
struct ViewSums {
  int views = 0;
  double log_psi_z_score = 0;  // logarithms, of two standard errors at least
  double log_background_psi_z_score = 0;
  double unexplained_grey = 0;
};
ViewSums sum_informative_views(std::span<const PoseFeatures> by_view);

}  // namespace edgescout
