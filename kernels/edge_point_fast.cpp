// The last stage, fast: the neighbours of a point are gathered first, then weighed eight at a time.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "kernels/edge_stages.h"
#include "kernels/simd.h"

namespace edgescout {

namespace {

constexpr int lanes = 8;
constexpr int window = 2 * int(EDGE_WINDOW) + 1;

struct Neighbours {
  static constexpr int capacity = (window * window + lanes - 1) / lanes * lanes;
  int count = 0;
  float dx[capacity], dy[capacity], gx[capacity], gy[capacity];
  void add(int x, int y, float a, float b) {
    dx[count] = static_cast<float>(x);
    dy[count] = static_cast<float>(y);
    gx[count] = a;
    gy[count++] = b;
  }
};

void gather(const EdgePlanes& planes, int x, int y, Neighbours& out) {
  constexpr int reach = EDGE_WINDOW;
  static_assert(window == 9, "a row of the window is a word of eight marks and one more");
  for (int dy = -reach; dy <= reach; ++dy) {
    const std::uint8_t* marks =
        planes.candidates.data() + planes.candidate_index(x - reach, y + dy);
    const std::ptrdiff_t row = std::ptrdiff_t(y + dy) * planes.width + x;
    std::uint64_t eight;
    std::memcpy(&eight, marks, sizeof eight);
    for (; eight; eight &= eight - 1) {
      const int dx = std::countr_zero(eight) / 8 - reach;
      out.add(dx, dy, planes.gx[row + dx], planes.gy[row + dx]);
    }
    if (marks[8]) out.add(reach, dy, planes.gx[row + reach], planes.gy[row + reach]);
  }
}

inline float falloff(float distance2, float reach) {
  const float rest = std::max(0.0f, 1 - distance2 * (1 / (reach * reach)));
  return rest * rest;
}

struct Lanes {
  float w[lanes] = {}, wu[lanes] = {}, wuu[lanes] = {}, wa[lanes] = {}, wua[lanes] = {};
};

// The sums of the line through the gradient's turn, in eight parts. `count` is a multiple of eight.
EDGESCOUT_SIMD_CLONES
void sum_turns(const Neighbours& q, int count, float nx, float ny, Lanes& sum) {
  for (int k = 0; k < count; k += lanes)
    for (int i = 0; i < lanes; ++i) {
      const float dx = q.dx[k + i], dy = q.dy[k + i], gx = q.gx[k + i], gy = q.gy[k + i];
      const float m2 = gx * gx + gy * gy, inverse = 1 / std::sqrt(m2);
      const float c = std::max(0.0f, (nx * gx + ny * gy) * inverse),
                  s = (nx * gy - ny * gx) * inverse;
      const float c2 = c * c, c4 = c2 * c2, u = dy * nx - dx * ny, v = dx * nx + dy * ny;
      const float a = s * (1 + s * s * (1.0f / 6));
      const float w =
          falloff(u * u, EDGE_REACH_ALONG) * falloff(v * v, EDGE_REACH_ACROSS) * c4 * c4 * m2;
      sum.w[i] += w;
      sum.wu[i] += w * u;
      sum.wuu[i] += w * u * u;
      sum.wa[i] += w * a;
      sum.wua[i] += w * u * a;
    }
}

float total(const float (&parts)[lanes]) {
  float sum = 0;
  for (float part : parts) sum += part;
  return sum;
}

float orientation(const EdgePlanes& planes, int x, int y, float nx, float ny) {
  Neighbours neighbours;
  gather(planes, x, y, neighbours);
  // What fills the last eight points away from the edge's gradient and so weighs nothing.
  while (neighbours.count % lanes) neighbours.add(0, 0, -nx, -ny);
  Lanes sum;
  sum_turns(neighbours, neighbours.count, nx, ny, sum);
  const float w = total(sum.w), wu = total(sum.wu), wuu = total(sum.wuu), wa = total(sum.wa),
              wua = total(sum.wua);
  const float slope = (w * wua - wu * wa) / (w * wuu - wu * wu + 0.5f * w * w);
  constexpr float pi = std::numbers::pi_v<float>;
  float theta = std::atan2(ny, nx) + pi / 2 + (wa - slope * wu) / w;
  theta -= pi * std::floor(theta / pi);
  return theta >= 0 && theta < pi ? theta : 0;
}

float magnitude(const EdgePlanes& planes, int x, int y) {
  const std::size_t i = std::size_t(y) * planes.width + x;
  const float gx = planes.gx[i], gy = planes.gy[i];
  return std::sqrt(gx * gx + gy * gy);
}

}  // namespace

EdgePoint edge_point_fast(const EdgePlanes& planes, const EdgePixel& pixel) {
  const int x = pixel.x, y = pixel.y;
  const std::size_t i = std::size_t(y) * planes.width + x;
  const float gx = planes.gx[i], gy = planes.gy[i], m = std::sqrt(static_cast<float>(pixel.m2));
  const int sx = gx < 0 ? -1 : 1, sy = gy < 0 ? -1 : 1;
  const bool level = std::abs(gx) >= std::abs(gy);
  const int ax = level ? sx : 0, ay = level ? 0 : sy;
  const float r = level ? std::abs(gy / gx) : std::abs(gx / gy);
  const auto log_ratio = [&](int k) {
    const float across = (1 - r) * magnitude(planes, x + k * ax, y + k * ay) +
                         r * magnitude(planes, x + k * sx, y + k * sy);
    return std::log(std::max(1.0f, across) / m);
  };
  const float before = log_ratio(-1), after = log_ratio(+1);
  const float t =
      std::clamp(0.5f * (before - after) / std::min(before + after, -1.0f / 256), -0.5f, 0.5f);
  return {float(x) + float(sx) * (level ? t : r * t), float(y) + float(sy) * (level ? r * t : t),
          orientation(planes, x, y, gx / m, gy / m), m / float(EDGE_GRADIENT_SCALE)};
}

}  // namespace edgescout
