// What every path of the edge detector shares: options, kernels, thresholds.
#include <algorithm>
#include <cmath>

#include "kernels/edge_stages.h"
#include "kernels/error.h"

namespace edgescout {

void EdgeOptions::validate() const {
  const auto fail = [](const char* field, double found, const char* bound) {
    throw InputError("options", std::string("edge.") + field, std::to_string(found), bound);
  };
  if (!(sigma_px >= 0.3f && sigma_px <= 8)) fail("sigma", sigma_px, "a value in [0.3, 8] px");
  if (!(low_threshold >= 0.1f && low_threshold <= 127))
    fail("low_threshold", low_threshold, "a value in [0.1, 127] grey levels a pixel");
  if (!(high_threshold >= low_threshold && high_threshold <= 127))
    fail("high_threshold", high_threshold, "a value from low_threshold to 127 grey levels a pixel");
  if (min_length_px < 1 || min_length_px > 10000)
    fail("min_length", min_length_px, "a value in [1, 10000] px");
}

EdgeWeights edge_weights(float sigma_px) {
  EdgeWeights weights;
  weights.radius =
      std::clamp(static_cast<int>(std::ceil(3.0 * sigma_px)), 1, static_cast<int>(EDGE_MAX_RADIUS));
  std::array<double, EDGE_MAX_RADIUS + 1> gauss{};
  double sum = 0, slope = 0;
  for (int i = 0; i <= weights.radius; ++i) {
    gauss[i] = std::exp(-0.5 * i * i / (double(sigma_px) * sigma_px));
    sum += (i == 0 ? 1 : 2) * gauss[i];
    slope += 2 * i * i * gauss[i];
  }
  // What rounding leaves over goes to the innermost weight, so that flat images and ramps are
  // answered exactly.
  weights.smooth[0] = 16384;
  weights.derivative[1] = 8192;
  for (int i = weights.radius; i >= 1; --i) {
    weights.smooth[i] = static_cast<std::int32_t>(std::lround(16384 * gauss[i] / sum));
    weights.smooth[0] -= 2 * weights.smooth[i];
    if (i == 1) break;
    weights.derivative[i] = static_cast<std::int32_t>(std::lround(16384 * i * gauss[i] / slope));
    weights.derivative[1] -= i * weights.derivative[i];
  }
  return weights;
}

std::int32_t edge_threshold(float grey_levels_per_px) {
  return std::max(1,
                  static_cast<std::int32_t>(std::lround(grey_levels_per_px * EDGE_GRADIENT_SCALE)));
}

}  // namespace edgescout
