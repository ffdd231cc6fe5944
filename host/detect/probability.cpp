#include "host/detect/probability.h"

#include <cmath>

namespace edgescout {

double pose_probability(const PoseFeatures& f) {
  constexpr double bias = -10.818, by_psi = 14.400, by_mean_px = -0.8480, by_matched = 0.508;
  if (f.points < 12) return 0;
  const double logit = bias + by_psi * f.psi + by_mean_px * f.mean_px + by_matched * f.matched;
  return f.in_image / (1 + std::exp(-logit));
}

}  // namespace edgescout
