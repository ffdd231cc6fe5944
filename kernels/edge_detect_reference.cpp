// The edge detector as defined in edge_stages.h, one pixel at a time; what the definition leaves to
// float is done in double.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/edge_stages.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// A gradient plane and its squared magnitude.
struct Gradient {
  std::span<const std::int16_t> pairs;
  int width;
  int gx(int x, int y) const { return pairs[2 * (std::size_t(y) * width + x)]; }
  int gy(int x, int y) const { return pairs[2 * (std::size_t(y) * width + x) + 1]; }
  std::uint32_t m2(int x, int y) const {
    return static_cast<std::uint32_t>(gx(x, y) * gx(x, y) + gy(x, y) * gy(x, y));
  }
};

// The two neighbours on either side of a pixel between which its gradient points.
struct Across {
  int axis_x, axis_y, sign_x, sign_y, larger, smaller;
};

Across across_edge(int gx, int gy) {
  const int sx = gx < 0 ? -1 : 1, sy = gy < 0 ? -1 : 1, ax = std::abs(gx), ay = std::abs(gy);
  if (ax >= ay) return {sx, 0, sx, sy, ax, ay};
  return {0, sy, sx, sy, ay, ax};
}

bool is_candidate(const Gradient& g, int x, int y, std::uint32_t low2) {
  const std::uint32_t here = g.m2(x, y);
  if (here < low2) return false;
  const Across a = across_edge(g.gx(x, y), g.gy(x, y));
  const std::uint32_t f = (256u * a.smaller + a.larger / 2) / a.larger;
  const auto ring = [&](int k) {
    return (256 - f) * (g.m2(x + k * a.axis_x, y + k * a.axis_y) >> 6) +
           f * (g.m2(x + k * a.sign_x, y + k * a.sign_y) >> 6);
  };
  const std::uint32_t centre = 256 * (here >> 6);
  return centre > ring(-1) && centre >= ring(+1);
}

// How far along the step across the edge the profile has its top.
double offset_across(const Gradient& g, int x, int y, const Across& a) {
  const double r = double(a.smaller) / a.larger, here = std::sqrt(double(g.m2(x, y)));
  const auto log_ratio = [&](int k) {
    const double near = std::sqrt(double(g.m2(x + k * a.axis_x, y + k * a.axis_y)));
    const double diagonal = std::sqrt(double(g.m2(x + k * a.sign_x, y + k * a.sign_y)));
    return std::log(std::max(1.0, (1 - r) * near + r * diagonal) / here);
  };
  const double before = log_ratio(-1), after = log_ratio(+1);
  return std::clamp(0.5 * (before - after) / std::min(before + after, -1.0 / 256), -0.5, 0.5);
}

double falloff(double distance, double reach) {
  const double rest = std::max(0.0, 1 - distance * distance / (reach * reach));
  return rest * rest;
}

// A weighted straight line through the gradient's turn against the distance along the edge, read
// off at the pixel itself.
double orientation_along(const Gradient& g, std::span<const std::uint8_t> candidates, int height,
                         int x, int y) {
  const double length = std::sqrt(double(g.m2(x, y))), nx = g.gx(x, y) / length,
               ny = g.gy(x, y) / length;
  const int reach = EDGE_WINDOW;
  double w = 0, wu = 0, wuu = 0, wa = 0, wua = 0;
  for (int qy = std::max(0, y - reach); qy <= std::min(height - 1, y + reach); ++qy)
    for (int qx = std::max(0, x - reach); qx <= std::min(g.width - 1, x + reach); ++qx) {
      if (!candidates[std::size_t(qy) * g.width + qx]) continue;
      const double gx = g.gx(qx, qy), gy = g.gy(qx, qy), dx = qx - x, dy = qy - y,
                   u = dy * nx - dx * ny;
      const double dot = nx * gx + ny * gy, agreement = std::max(0.0, dot / std::hypot(gx, gy));
      if (agreement == 0) continue;
      const double sine = (nx * gy - ny * gx) / std::hypot(gx, gy),
                   turn = sine * (1 + sine * sine / 6);
      const double weight = falloff(u, EDGE_REACH_ALONG) *
                            falloff(dx * nx + dy * ny, EDGE_REACH_ACROSS) * std::pow(agreement, 8) *
                            (gx * gx + gy * gy);
      w += weight;
      wu += weight * u;
      wuu += weight * u * u;
      wa += weight * turn;
      wua += weight * u * turn;
    }
  const double slope = (w * wua - wu * wa) / (w * wuu - wu * wu + 0.5 * w * w);
  const double theta = std::atan2(ny, nx) + std::numbers::pi / 2 + (wa - slope * wu) / w;
  return theta - std::numbers::pi * std::floor(theta / std::numbers::pi);
}

// Marks the component of (x, y) as visited and returns its pixels.
std::vector<std::size_t> take_component(std::vector<std::uint8_t>& left, int width, int height,
                                        std::size_t start) {
  std::vector<std::size_t> pixels{start};
  left[start] = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int x = static_cast<int>(pixels[i] % width), y = static_cast<int>(pixels[i] / width);
    for (int qy = std::max(0, y - 1); qy <= std::min(height - 1, y + 1); ++qy)
      for (int qx = std::max(0, x - 1); qx <= std::min(width - 1, x + 1); ++qx) {
        const std::size_t q = std::size_t(qy) * width + qx;
        if (!left[q]) continue;
        left[q] = 0;
        pixels.push_back(q);
      }
  }
  return pixels;
}

}  // namespace

std::vector<std::int16_t> edge_gradient_reference(const ImageView& image,
                                                  const EdgeWeights& weights) {
  const int width = image.width, height = image.height;
  const auto at = [&](int x, int y) {
    return int(image.pixels[std::size_t(std::clamp(y, 0, height - 1)) * width +
                            std::clamp(x, 0, width - 1)]);
  };
  const auto smooth = [&](int x, int y) {
    int sum = weights.smooth[0] * at(x, y);
    for (int i = 1; i <= weights.radius; ++i)
      sum += weights.smooth[i] * (at(x - i, y) + at(x + i, y));
    return (sum + 64) >> 7;
  };
  const auto differentiate = [&](int x, int y) {
    int sum = 0;
    for (int i = 1; i <= weights.radius; ++i)
      sum += weights.derivative[i] * (at(x + i, y) - at(x - i, y));
    return (sum + 64) >> 7;
  };
  std::vector<std::int16_t> gradient;
  gradient.reserve(std::size_t(width) * height * 2);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int gx = weights.smooth[0] * differentiate(x, y), gy = 0;
      for (int i = 1; i <= weights.radius; ++i) {
        gx += weights.smooth[i] * (differentiate(x, y - i) + differentiate(x, y + i));
        gy += weights.derivative[i] * (smooth(x, y + i) - smooth(x, y - i));
      }
      gradient.push_back(static_cast<std::int16_t>((gx + 8192) >> 14));
      gradient.push_back(static_cast<std::int16_t>((gy + 8192) >> 14));
    }
  return gradient;
}

std::vector<std::uint8_t> edge_thin_reference(std::span<const std::int16_t> gradient, int width,
                                              int height, std::int32_t low) {
  std::vector<std::uint8_t> candidates(std::size_t(width) * height, 0);
  const Gradient g{gradient, width};
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x)
      candidates[std::size_t(y) * width + x] =
          is_candidate(g, x, y, static_cast<std::uint32_t>(low * low));
  return candidates;
}

std::vector<std::uint8_t> edge_link_reference(std::span<const std::int16_t> gradient,
                                              std::span<const std::uint8_t> candidates, int width,
                                              int height, std::int32_t high, int min_length_px) {
  std::vector<std::uint8_t> left(candidates.begin(), candidates.end()), kept(candidates.size(), 0);
  const Gradient g{gradient, width};
  for (std::size_t start = 0; start < left.size(); ++start) {
    if (!left[start]) continue;
    const std::vector<std::size_t> pixels = take_component(left, width, height, start);
    const bool strong = std::ranges::any_of(pixels, [&](std::size_t p) {
      return g.m2(static_cast<int>(p % width), static_cast<int>(p / width)) >=
             static_cast<std::uint32_t>(high * high);
    });
    if (!strong || pixels.size() < static_cast<std::size_t>(min_length_px)) continue;
    for (std::size_t p : pixels) kept[p] = 1;
  }
  return kept;
}

EdgePoint edge_point_reference(std::span<const std::int16_t> gradient,
                               std::span<const std::uint8_t> candidates, int width, int height,
                               int x, int y) {
  const Gradient g{gradient, width};
  const Across a = across_edge(g.gx(x, y), g.gy(x, y));
  const double t = offset_across(g, x, y, a), minor = t * a.smaller / a.larger;
  const bool along_x = a.axis_x != 0;
  float theta = static_cast<float>(orientation_along(g, candidates, height, x, y));
  if (theta >= std::numbers::pi_v<float>) theta = 0;
  return {static_cast<float>(x + a.sign_x * (along_x ? t : minor)),
          static_cast<float>(y + a.sign_y * (along_x ? minor : t)), theta,
          static_cast<float>(std::sqrt(double(g.m2(x, y))) / EDGE_GRADIENT_SCALE)};
}

std::vector<EdgePoint> detect_edges_reference(const ImageView& image, const EdgeOptions& options) {
  options.validate();
  check(image.width > 0 && image.height > 0 && image.pixels,
        "detect_edges: an image without pixels");
  const int width = image.width, height = image.height;
  const auto gradient = edge_gradient_reference(image, edge_weights(options.sigma_px));
  const auto candidates =
      edge_thin_reference(gradient, width, height, edge_threshold(options.low_threshold));
  const auto kept =
      edge_link_reference(gradient, candidates, width, height,
                          edge_threshold(options.high_threshold), options.min_length_px);
  std::vector<EdgePoint> points;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (kept[std::size_t(y) * width + x])
        points.push_back(edge_point_reference(gradient, candidates, width, height, x, y));
  return points;
}

}  // namespace edgescout
