// The trilinear interpolant of the tensor, with its own derivative.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/pose_normal_equations.h"

namespace edgescout {

float tensor_lookup(const TensorView& view, float x_px, float y_px, float theta_rad,
                    float derivative[3]) {
  const TensorShape& s = view.shape;
  const float inside_x = std::clamp(x_px, 0.0f, float(s.width - 1)),
              inside_y = std::clamp(y_px, 0.0f, float(s.height - 1));
  const int x0 = std::min(int(inside_x), std::max(0, s.width - 2)),
            y0 = std::min(int(inside_y), std::max(0, s.height - 2));
  const int x1 = std::min(x0 + 1, s.width - 1), y1 = std::min(y0 + 1, s.height - 1);
  const float ax = inside_x - float(x0), ay = inside_y - float(y0);
  const float turn = theta_rad * (float(s.bins) / std::numbers::pi_v<float>);
  const float whole = std::floor(turn);
  const float ak = turn - whole;
  const int k0 = ((int(whole) % s.bins) + s.bins) % s.bins, k1 = k0 + 1 == s.bins ? 0 : k0 + 1;
  const auto at = [&](int x, int y, int k) {
    return float(view.tensor[s.index(x, y, k)]) * (1.0f / DCD_UNITS_PER_PX);
  };
  // Between the two bins first, then bilinear.
  float value[2][2], slope[2][2];
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int x = i ? x1 : x0, y = j ? y1 : y0;
      const float below = at(x, y, k0), above = at(x, y, k1);
      slope[j][i] = above - below;
      value[j][i] = below + ak * slope[j][i];
    }
  const auto blend = [&](const float v[2][2]) {
    return (1 - ay) * ((1 - ax) * v[0][0] + ax * v[0][1]) +
           ay * ((1 - ax) * v[1][0] + ax * v[1][1]);
  };
  const float out_x = x_px - inside_x, out_y = y_px - inside_y,
              out = std::sqrt(out_x * out_x + out_y * out_y);
  if (derivative) {
    derivative[0] = out_x != 0
                        ? out_x / out
                        : (1 - ay) * (value[0][1] - value[0][0]) + ay * (value[1][1] - value[1][0]);
    derivative[1] = out_y != 0
                        ? out_y / out
                        : (1 - ax) * (value[1][0] - value[0][0]) + ax * (value[1][1] - value[0][1]);
    derivative[2] = blend(slope) * (float(s.bins) / std::numbers::pi_v<float>);
  }
  return blend(value) + out;
}

}  // namespace edgescout
