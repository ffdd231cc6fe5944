#include "host/edge/edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "kernels/backend.h"
#include "kernels/error.h"

namespace edgescout {

static void PrintTo(EdgeMethod method, std::ostream* out) { *out << name_of(method); }

namespace {

constexpr double pi = std::numbers::pi;

// A bright half plane beyond the line through (cx, cy) with normal direction phi; pixels are
// covered by area (nearly), blurred a little, noisy.
Image half_plane(int width, int height, double cx, double cy, double phi, double contrast,
                 unsigned seed) {
  std::mt19937 rng(seed);
  std::normal_distribution<double> noise(0, 2);
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double d = (x - cx) * std::cos(phi) + (y - cy) * std::sin(phi);
      const double grey =
          120 + contrast * 0.5 * std::erf(d / (0.7 * std::numbers::sqrt2)) + noise(rng);
      image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(std::round(grey), 0.0, 255.0)));
    }
  return image;
}

double angle_between(double a, double b) {
  const double d = std::abs(std::remainder(a - b, pi));
  return d;
}

class BothMethods : public testing::TestWithParam<EdgeMethod> {};

TEST_P(BothMethods, FindALineWithoutBias) {
  const auto backend = make_cpu_backend(1);
  EdgesOptions options;
  options.method = GetParam();
  for (int k = 0; k < 12; ++k) {
    const double phi = 0.1 + k * pi / 6, cx = 60.3 + 0.07 * k, cy = 48.1 - 0.11 * k;
    const Image image = half_plane(121, 97, cx, cy, phi, 80, 100 + k);
    double offset = 0;
    int count = 0;
    for (const EdgePoint& p : find_edges(image, options, *backend)) {
      if (p.x_px < 4 || p.y_px < 4 || p.x_px > 116 || p.y_px > 92) continue;
      const double d = (p.x_px - cx) * std::cos(phi) + (p.y_px - cy) * std::sin(phi);
      EXPECT_LT(std::abs(d), 0.6) << name_of(options.method) << " phi " << phi;
      EXPECT_LT(angle_between(p.theta_rad, phi + pi / 2), 0.05)
          << name_of(options.method) << " phi " << phi;
      EXPECT_GE(p.theta_rad, 0.0f);
      EXPECT_LT(p.theta_rad, std::numbers::pi_v<float>);
      EXPECT_GT(p.strength, 3.0f);
      offset += d;
      ++count;
    }
    EXPECT_GT(count, 60);
    EXPECT_NEAR(offset / count, 0, options.method == EdgeMethod::Lsd ? 0.12 : 0.02)
        << name_of(options.method) << " phi " << phi;
  }
}

INSTANTIATE_TEST_SUITE_P(Edges, BothMethods, testing::Values(EdgeMethod::Gradient, EdgeMethod::Lsd),
                         [](const auto& test) { return name_of(test.param); });

TEST(LsdEdges, CoarseLevelsAddOnlyWhatTheFineOnesMiss) {
  // A sharp line for the finest level and a soft ramp that only the coarse levels find.
  Image image = half_plane(256, 256, 60, 128, 0, 90, 7);
  for (int y = 0; y < 256; ++y)
    for (int x = 110; x < 256; ++x) {
      const double grey = image.at(x, y) - 60 * 0.5 * (1 + std::erf((x - 190) / 14.0));
      image.pixels[y * 256 + x] =
          static_cast<std::uint8_t>(std::clamp(std::round(grey), 0.0, 255.0));
    }
  const auto near = [](const std::vector<EdgePoint>& points, double x0, double reach) {
    return std::ranges::count_if(points, [&](const EdgePoint& p) {
      return std::abs(p.x_px - x0) < reach && angle_between(p.theta_rad, pi / 2) < 0.2;
    });
  };
  const auto fine = lsd_edges(image, {1}), all = lsd_edges(image, {4});
  EXPECT_GT(near(fine, 60, 2), 200);
  EXPECT_EQ(near(fine, 60, 4), near(all, 60, 4)) << "the line stays as the finest level drew it";
  EXPECT_LT(near(fine, 190, 16), 20);
  EXPECT_GT(near(all, 190, 16), 150);
}

TEST(LsdEdges, PointsStepOnePixelAlongTheSegment) {
  const auto points = lsd_edges(half_plane(120, 120, 60, 60, 0.4, 90, 3), {1});
  ASSERT_GT(points.size(), 50u);
  int unit_steps = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step =
        std::hypot(points[i].x_px - points[i - 1].x_px, points[i].y_px - points[i - 1].y_px);
    unit_steps += std::abs(step - 1) < 0.05;
  }
  EXPECT_GT(unit_steps, 0.8 * points.size());
}

TEST(EdgesOptions, NamesAndBounds) {
  EXPECT_EQ(edge_method_from_name("gradient"), EdgeMethod::Gradient);
  EXPECT_EQ(edge_method_from_name(name_of(EdgeMethod::Lsd)), EdgeMethod::Lsd);
  EXPECT_THROW(edge_method_from_name("canny"), InputError);
  EdgesOptions options;
  EXPECT_NO_THROW(options.validate());
  options.lsd.levels = 0;
  EXPECT_THROW(options.validate(), InputError);
  options.lsd.levels = 7;
  EXPECT_THROW(options.validate(), InputError);
  options.lsd.levels = 2;
  options.gradient.sigma_px = -1;
  EXPECT_THROW(options.validate(), InputError);
  const auto backend = make_cpu_backend(1);
  EXPECT_THROW(find_edges(half_plane(32, 32, 16, 16, 0, 80, 1), options, *backend), InputError);
}

}  // namespace
}  // namespace edgescout
