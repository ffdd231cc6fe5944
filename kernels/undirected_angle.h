// The direction of a line, which has no sense: an angle in [0, pi), by arithmetic that the compiler
// turns into vectors.
#pragma once

#include <algorithm>
#include <cmath>

namespace edgescout {

// atan2 folded to [0, pi), 2e-6 rad at worst: an odd minimax polynomial on [0, 1] and the octant
// put back.
inline float undirected_angle(float dx, float dy) {
  constexpr float pi = 3.14159265f;
  const float ax = std::fabs(dx), ay = std::fabs(dy);
  const float big = std::max(std::max(ax, ay), 1e-30f), small = std::min(ax, ay);
  const float t = small / big, t2 = t * t;
  float a =
      t * (0.99997726f +
           t2 * (-0.33262347f +
                 t2 * (0.19354346f + t2 * (-0.11643287f + t2 * (0.05265332f - t2 * 0.01172120f)))));
  a = ay > ax ? 0.5f * pi - a : a;
  a = (dx < 0) != (dy < 0) ? pi - a : a;
  return a >= pi ? a - pi : a;
}

}  // namespace edgescout
