// The edge detector, fast: gradient and thinning by bands of rows (files of their own), components by
// union-find over the list of candidates, and points only where a pixel is kept.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "kernels/edge_stages.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// Candidates under one root; a root is the first of its component.
class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

Components connect(const std::vector<EdgePixel>& pixels) {
  Components components(pixels.size());
  std::uint32_t above = 0;  // first candidate that may still touch the next one from the row above
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    const EdgePixel& p = pixels[i];
    if (i > 0 && pixels[i - 1].y == p.y && pixels[i - 1].x == p.x - 1) components.join(i - 1, i);
    while (pixels[above].y < p.y - 1 || (pixels[above].y == p.y - 1 && pixels[above].x < p.x - 1)) ++above;
    for (std::uint32_t j = above; pixels[j].y == p.y - 1 && pixels[j].x <= p.x + 1; ++j)
      components.join(j, i);
  }
  return components;
}

struct Turn {
  float w = 0, wu = 0, wuu = 0, wa = 0, wua = 0;
};

inline float falloff(float distance2, float reach) {
  const float rest = std::max(0.0f, 1 - distance2 * (1 / (reach * reach)));
  return rest * rest;
}

// Adds one neighbour to the line through the gradient's turn.
inline void add_neighbour(float nx, float ny, int dx, int dy, float gx, float gy, Turn& sum) {
  const float dot = nx * gx + ny * gy;
  if (dot <= 0) return;
  const float u = float(dy) * nx - float(dx) * ny, v = float(dx) * nx + float(dy) * ny;
  const float m2 = gx * gx + gy * gy, c2 = dot * dot / m2, c4 = c2 * c2;
  const float sine = (nx * gy - ny * gx) / std::sqrt(m2), a = sine * (1 + sine * sine * (1.0f / 6));
  const float w = falloff(u * u, EDGE_REACH_ALONG) * falloff(v * v, EDGE_REACH_ACROSS) * c4 * c4 * m2;
  sum.w += w;
  sum.wu += w * u;
  sum.wuu += w * u * u;
  sum.wa += w * a;
  sum.wua += w * u * a;
}

float orientation(const EdgePlanes& planes, int x, int y, float nx, float ny) {
  constexpr int reach = EDGE_WINDOW;
  Turn sum;
  for (int dy = -reach; dy <= reach; ++dy) {
    const std::uint8_t* marks = planes.candidates.data() + planes.candidate_index(x - reach, y + dy);
    std::uint64_t eight;
    std::memcpy(&eight, marks, sizeof eight);
    if (eight == 0 && !marks[8]) continue;
    for (int k = 0; k <= 2 * reach; ++k) {
      if (!marks[k]) continue;
      const std::size_t q = std::size_t(y + dy) * planes.width + x + k - reach;
      add_neighbour(nx, ny, k - reach, dy, planes.gx[q], planes.gy[q], sum);
    }
  }
  const float slope =
      (sum.w * sum.wua - sum.wu * sum.wa) / (sum.w * sum.wuu - sum.wu * sum.wu + 0.5f * sum.w * sum.w);
  constexpr float pi = std::numbers::pi_v<float>;
  float theta = std::atan2(ny, nx) + pi / 2 + (sum.wa - slope * sum.wu) / sum.w;
  theta -= pi * std::floor(theta / pi);
  return theta >= 0 && theta < pi ? theta : 0;
}

float magnitude(const EdgePlanes& planes, int x, int y) {
  const std::size_t i = std::size_t(y) * planes.width + x;
  const float gx = planes.gx[i], gy = planes.gy[i];
  return std::sqrt(gx * gx + gy * gy);
}

}  // namespace

void edge_link_fast(std::int32_t high, int min_length_px, std::vector<EdgePixel>& pixels) {
  Components components = connect(pixels);
  std::vector<std::uint32_t> root(pixels.size());
  struct Chain {
    std::int32_t length = 0;
    std::uint32_t strongest = 0;
  };
  std::vector<Chain> chains(pixels.size());
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    root[i] = components.root(i);
    Chain& chain = chains[root[i]];
    ++chain.length;
    chain.strongest = std::max(chain.strongest, pixels[i].m2);
  }
  const auto high2 = static_cast<std::uint32_t>(high * high);
  std::size_t kept = 0;
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    const Chain& chain = chains[root[i]];
    if (chain.length >= min_length_px && chain.strongest >= high2) pixels[kept++] = pixels[i];
  }
  pixels.resize(kept);
}

EdgePoint edge_point_fast(const EdgePlanes& planes, const EdgePixel& pixel) {
  const int x = pixel.x, y = pixel.y;
  const std::size_t i = std::size_t(y) * planes.width + x;
  const float gx = planes.gx[i], gy = planes.gy[i], m = std::sqrt(static_cast<float>(pixel.m2));
  const int sx = gx < 0 ? -1 : 1, sy = gy < 0 ? -1 : 1;
  const bool level = std::abs(gx) >= std::abs(gy);
  const int ax = level ? sx : 0, ay = level ? 0 : sy;
  const float r = level ? std::abs(gy / gx) : std::abs(gx / gy);
  const auto log_ratio = [&](int k) {
    const float across =
        (1 - r) * magnitude(planes, x + k * ax, y + k * ay) + r * magnitude(planes, x + k * sx, y + k * sy);
    return std::log(std::max(1.0f, across) / m);
  };
  const float before = log_ratio(-1), after = log_ratio(+1);
  const float t = std::clamp(0.5f * (before - after) / std::min(before + after, -1.0f / 256), -0.5f, 0.5f);
  return {float(x) + float(sx) * (level ? t : r * t), float(y) + float(sy) * (level ? r * t : t),
          orientation(planes, x, y, gx / m, gy / m), m / float(EDGE_GRADIENT_SCALE)};
}

std::vector<EdgePoint> detect_edges_fast(const ImageView& image, const EdgeOptions& options,
                                         ThreadPool& pool) {
  options.validate();
  check(image.width > 0 && image.height > 0 && image.pixels, "detect_edges: an image without pixels");
  EdgePlanes planes(image.width, image.height);
  edge_gradient_fast(image, edge_weights(options.sigma_px), pool, planes);
  std::vector<EdgePixel> pixels = edge_thin_fast(edge_threshold(options.low_threshold), pool, planes);
  edge_link_fast(edge_threshold(options.high_threshold), options.min_length_px, pixels);
  std::vector<EdgePoint> points(pixels.size());
  constexpr std::size_t share = 512;
  pool.for_each((points.size() + share - 1) / share, [&](std::size_t part) {
    for (std::size_t i = part * share; i < std::min(points.size(), (part + 1) * share); ++i)
      points[i] = edge_point_fast(planes, pixels[i]);
  });
  return points;
}

}  // namespace edgescout
