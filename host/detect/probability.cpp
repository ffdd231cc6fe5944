#include "host/detect/probability.h"

#include <cmath>

namespace edgescout {

double pose_probability(const PoseFeatures& f) {
  constexpr double fewest_points = 12;  // fewer lie on any image's edges somewhere
  return f.points < fewest_points ? 0 : f.in_image / (1 + std::exp(-log_odds(f)));
}

}  // namespace edgescout
