#include "host/detect/probability.h"

#include <algorithm>
#include <cmath>

namespace edgescout {

double pose_probability(const PoseFeatures& f) {
  constexpr double bias = -4.798, by_log_evidence = 3.716, by_mean_px = -0.6305, by_unexplained = -3.028;
  constexpr double least_evidence = 0.5;  // below that all poses are as bad
  constexpr double fewest_points = 12;    // fewer lie on any image's edges somewhere
  if (f.points < fewest_points) return 0;
  const double logit = bias + by_log_evidence * std::log(std::max(evidence(f), least_evidence)) + by_mean_px * f.mean_px +
                       by_unexplained * unexplained_grey(f.shading);
  return f.in_image / (1 + std::exp(-logit));
}

}  // namespace edgescout
