#include "host/detect/probability.h"

#include <cmath>

namespace edgescout {

double pose_probability(const PoseFeatures& f) {
  constexpr double bias = -14.0, by_psi = 14.0, by_mean_px = -0.1, by_matched = 6.0;
  if (f.points < 12) return 0;
  const double logit = bias + by_psi * f.psi + by_mean_px * f.mean_px + by_matched * f.matched;
  return f.in_image / (1 + std::exp(-logit));
}

}  // namespace edgescout
