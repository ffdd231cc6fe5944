#include "host/detect/probability.h"

#include <cmath>

#include "host/register/odds_weights.h"

namespace edgescout {

double pose_probability(const PoseFeatures& f) {
  constexpr double fewest_points = 12;  // fewer lie on any image's edges somewhere
  return f.points < fewest_points
             ? 0
             : f.in_image / (1 + std::exp(-weighted_odds(f, {-4.798, 3.716, -0.6305, -3.028})));
}

}  // namespace edgescout
