// How well edges are found: synthetic edges of known place and direction, box-filtered pixels, blur
// 0.6 px, noise. The bounds are what was measured (docs/research/edges.md) and a tenth or so more;
// the measured figures are printed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>

#include "kernels/edge_detect.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int margin = 8;

// Positive inside the bright part; px.
using SignedDistance = std::function<double(double, double)>;

double coverage(const SignedDistance& distance, int x, int y) {
  const double centre = distance(x, y);
  if (std::abs(centre) > 1) return centre > 0;
  constexpr int samples = 8;
  int inside = 0;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i)
      inside += distance(x + (i + 0.5) / samples - 0.5, y + (j + 0.5) / samples - 0.5) > 0;
  return inside / double(samples * samples);
}

std::vector<double> blur(const std::vector<double>& image, int size, double sigma) {
  const int radius = 3;
  std::vector<double> across(image.size()), out(image.size());
  const auto pass = [&](const std::vector<double>& from, std::vector<double>& to, int step_x,
                        int step_y) {
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        double sum = 0, weights = 0;
        for (int i = -radius; i <= radius; ++i) {
          const double w = std::exp(-0.5 * i * i / (sigma * sigma));
          sum += w * from[std::clamp(y + i * step_y, 0, size - 1) * size +
                          std::clamp(x + i * step_x, 0, size - 1)];
          weights += w;
        }
        to[y * size + x] = sum / weights;
      }
  };
  pass(image, across, 1, 0);
  pass(across, out, 0, 1);
  return out;
}

std::vector<std::uint8_t> photograph(const SignedDistance& distance, int size, double contrast,
                                     double noise_levels, std::mt19937& rng) {
  std::vector<double> grey;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      grey.push_back(128 + contrast * (coverage(distance, x, y) - 0.5));
  std::normal_distribution<double> noise(0, 1);
  std::vector<std::uint8_t> pixels;
  for (double g : blur(grey, size, 0.6))
    pixels.push_back(static_cast<std::uint8_t>(
        std::clamp(std::round(g + noise_levels * noise(rng)), 0.0, 255.0)));
  return pixels;
}

struct Errors {
  double sum = 0, square = 0;
  int count = 0;
  void add(double e) {
    sum += e;
    square += e * e;
    ++count;
  }
  double mean() const { return sum / count; }
  double rms() const { return std::sqrt(square / count); }
};

// A straight edge (radius 0) or a disc, and what its edges must not exceed.
struct Bound {
  const char* name;
  double radius_px, contrast, noise;
  double position_bias, position_rms, orientation_rms;  // px, px, rad
};

void PrintTo(const Bound& bound, std::ostream* out) {
  *out << bound.name << " contrast " << bound.contrast << " noise " << bound.noise;
}

struct Measured {
  Errors position, orientation;
  int stray = 0;      // further than 2 px from the edge
  double length = 0;  // of the edge, px
};

double length_inside(double x0, double y0, double phi, int size) {
  double length = 0;
  for (double t = -size; t < size; t += 0.05) {
    const double x = x0 - t * std::sin(phi), y = y0 + t * std::cos(phi);
    length +=
        0.05 * (x >= margin && y >= margin && x <= size - 1 - margin && y <= size - 1 - margin);
  }
  return length;
}

Measured measure(const Bound& bound, int pictures) {
  std::mt19937 rng(2024);
  std::uniform_real_distribution<double> unit(0, 1);
  ThreadPool pool(1);
  Measured result;
  const int size = bound.radius_px > 0 ? static_cast<int>(2 * bound.radius_px) + 3 * margin : 64;
  const int middle = size / 2;
  for (int k = 0; k < pictures; ++k) {
    const double phi = unit(rng) * 2 * pi, cx = middle + unit(rng), cy = middle + unit(rng);
    const SignedDistance distance = [&](double x, double y) {
      return bound.radius_px > 0 ? bound.radius_px - std::hypot(x - cx, y - cy)
                                 : (x - cx) * std::cos(phi) + (y - cy) * std::sin(phi);
    };
    const auto pixels = photograph(distance, size, bound.contrast, bound.noise, rng);
    for (const EdgePoint& p : detect_edges_fast({size, size, pixels.data()}, {}, pool)) {
      if (p.x_px < margin || p.y_px < margin || p.x_px > size - 1 - margin ||
          p.y_px > size - 1 - margin)
        continue;
      const double off = distance(p.x_px, p.y_px),
                   normal = bound.radius_px > 0 ? std::atan2(p.y_px - cy, p.x_px - cx) : phi;
      if (std::abs(off) > 2) {
        ++result.stray;
        continue;
      }
      result.position.add(off);
      result.orientation.add(std::remainder(p.theta_rad - normal - pi / 2, pi));
    }
    result.length +=
        bound.radius_px > 0 ? 2 * pi * bound.radius_px : length_inside(cx, cy, phi, size);
  }
  return result;
}

class EdgeAccuracy : public testing::TestWithParam<Bound> {};

TEST_P(EdgeAccuracy, StaysWithinWhatWasMeasured) {
  const Bound bound = GetParam();
  const Measured m = measure(bound, 30);
  std::printf("| %s | %g | %g | %+.3f | %.3f | %.4f | %.2f |\n", bound.name, bound.contrast,
              bound.noise, m.position.mean(), m.position.rms(), m.orientation.rms(),
              m.position.count / m.length);
  EXPECT_LT(std::abs(m.position.mean()), bound.position_bias);
  EXPECT_LT(m.position.rms(), bound.position_rms);
  EXPECT_LT(m.orientation.rms(), bound.orientation_rms);
  EXPECT_EQ(m.stray, 0);
  // Every pixel the edge passes gives about one point: a line at 45 degrees has 0.7 a px, a
  // staircase up to 1.4.
  EXPECT_GT(m.position.count / m.length, 1.0);
  EXPECT_LT(m.position.count / m.length, 1.3);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EdgeAccuracy,
                         testing::Values(Bound{"line", 0, 20, 2, 0.010, 0.115, 0.024},
                                         Bound{"line", 0, 50, 2, 0.005, 0.047, 0.0090},
                                         Bound{"line", 0, 100, 2, 0.005, 0.028, 0.0050},
                                         Bound{"line", 0, 100, 0, 0.003, 0.018, 0.0030},
                                         Bound{"disc of 40 px", 40, 20, 2, 0.025, 0.115, 0.024},
                                         Bound{"disc of 40 px", 40, 50, 2, 0.025, 0.052, 0.0090},
                                         Bound{"disc of 40 px", 40, 100, 2, 0.025, 0.035, 0.0050},
                                         Bound{"disc of 10 px", 10, 20, 2, 0.085, 0.150, 0.034},
                                         Bound{"disc of 10 px", 10, 50, 2, 0.085, 0.100, 0.0130},
                                         Bound{"disc of 10 px", 10, 100, 2, 0.085, 0.090, 0.0070},
                                         Bound{"disc of 5 px", 5, 50, 2, 0.17, 0.18, 0.022},
                                         Bound{"disc of 5 px", 5, 100, 2, 0.17, 0.17, 0.0120}));

TEST(EdgeSensitivity, FindsTenGreyLevelsInNoise) {
  const Measured m = measure({"line", 0, 10, 2, 0, 0, 0}, 30);
  EXPECT_GT(m.position.count / m.length, 1.0);
  EXPECT_EQ(m.stray, 0);
  EXPECT_LT(m.orientation.rms(), 0.06);
}

TEST(EdgeSensitivity, NoiseAloneGivesNoEdges) {
  std::mt19937 rng(5);
  const auto pixels = photograph([](double, double) { return 5.0; }, 300, 40, 2, rng);
  ThreadPool pool(1);
  EXPECT_TRUE(detect_edges_fast({300, 300, pixels.data()}, {}, pool).empty());
}

}  // namespace
}  // namespace edgescout
