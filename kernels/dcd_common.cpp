// What every path of the DCD tensor shares: options, weights, seeds.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/dcd_tensor.h"
#include "kernels/error.h"

namespace edgescout {

void TensorOptions::validate() const {
  const auto fail = [](const char* field, double found, const char* bound) {
    throw InputError("options", std::string("tensor.") + field, std::to_string(found), bound);
  };
  if (bins < 4 || bins > int(DCD_MAX_BINS) || bins % 2 != 0)
    fail("bins", bins, "an even number in [4, 128]");
  if (!(lambda_px_per_rad >= 0 && lambda_px_per_rad <= 1e4f))
    fail("lambda", lambda_px_per_rad, "a value in [0, 10000] px/rad");
  if (!(smoothing_variance >= 0 && smoothing_variance <= 16))
    fail("smoothing_variance", smoothing_variance, "a value in [0, 16] bins^2");
  if (!(cap_px > 0 && cap_px <= float(DCD_MAX_CAP_PX)))
    fail("cap", cap_px, "a value in (0, 255] px");
}

std::vector<std::uint16_t> smoothing_weights(float variance_bins, int bins) {
  const int radius =
      std::min(static_cast<int>(std::ceil(3.0 * std::sqrt(double(variance_bins)))), bins / 2 - 1);
  std::vector<double> half(radius + 1);
  double total = 0;
  for (int d = 0; d <= radius; ++d) {
    half[d] = d == 0 ? 1.0 : std::exp(-0.5 * d * d / double(variance_bins));
    total += (d == 0 ? 1 : 2) * half[d];
  }
  std::vector<std::uint16_t> weights(radius + 1);
  int remainder = 32768;
  for (int d = radius; d > 0; --d) {
    weights[d] = static_cast<std::uint16_t>(std::lround(32768.0 * half[d] / total));
    remainder -= 2 * weights[d];
  }
  weights[0] = static_cast<std::uint16_t>(remainder);
  return weights;
}

std::uint16_t orientation_step(const TensorOptions& options) {
  const double step =
      DCD_UNITS_PER_PX * double(options.lambda_px_per_rad) * std::numbers::pi / options.bins;
  return static_cast<std::uint16_t>(std::min(65535.0, std::round(step)));
}

Seed seed_of(const EdgePoint& point, const TensorShape& shape) {
  const float x = std::round(point.x_px), y = std::round(point.y_px);
  if (!(x >= 0 && x < float(shape.width) && y >= 0 && y < float(shape.height) &&
        std::isfinite(point.theta_rad)))
    return {0, 0, -1};
  const int turns =
      static_cast<int>(std::lround(point.theta_rad * (shape.bins / std::numbers::pi_v<float>)));
  return {static_cast<int>(x), static_cast<int>(y),
          ((turns % shape.bins) + shape.bins) % shape.bins};
}

}  // namespace edgescout
