// edge_support against an oracle written from edge_support.h's prose alone, and against results
// worked out by hand.
#include <cmath>
#include <numbers>

#include "tests/kernels/edge_support_cases.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

using Real = long double;

struct OracleView {
  const test::Picture& picture;
  std::vector<std::uint32_t> map = support_map_reference(picture.view());
  bool supports(int x, int y, int bin) const {
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return false;
    return map[std::size_t(y) * std::size_t(picture.width) + std::size_t(x)] & 1u << bin;
  }
};

// How often copies displaced by 7 and 14 px in 8 directions are supported.
std::vector<bool> copies(const OracleView& view, const SupportPoint& p) {
  std::vector<bool> supported;
  for (const Real length : {7.0L, 14.0L})
    for (int k = 0; k < 8; ++k) {
      const Real angle = k * std::numbers::pi_v<Real> / 4;
      supported.push_back(
          view.supports(p.x_px + static_cast<int>(std::lround(length * std::cos(angle))),
                        p.y_px + static_cast<int>(std::lround(length * std::sin(angle))), p.bin));
    }
  return supported;
}

Real log_ratio(bool supported, int chance, bool interior) {
  const Real p1 = interior ? 0.7L : 0.85L, p0 = std::clamp(chance / 16.0L, 1 / 32.0L, p1);
  const Real l = supported ? std::log(p1 / p0) : std::log((1 - p1) / (1 - p0));
  return std::round(64 * l) / 64;
}

Real over_sectors(std::span<const Real> sums) {
  Real total = 0;
  for (const Real sum : sums) total += std::log(0.8L * std::exp(sum) + 0.2L);
  return total;
}

EdgeSupport oracle(const OracleView& view, std::span<const SupportPoint> points) {
  std::array<Real, 12> all{}, inside{};
  std::array<Real, 17> supported{};
  Real weight = 0;
  for (const SupportPoint& p : points) {
    const Real w = p.weight / 1024.0L;
    const bool here = view.supports(p.x_px, p.y_px, p.bin), interior = p.part >= 12;
    const std::vector<bool> displaced = copies(view, p);
    const Real l = log_ratio(here, int(std::ranges::count(displaced, true)), interior);
    all[p.part % 12] += w * l;
    if (interior) inside[p.part % 12] += w * l;
    supported[0] += here * w;
    for (std::size_t k = 0; k < 16; ++k) supported[k + 1] += displaced[k] * w;
    weight += w;
  }
  if (weight == 0) return {};
  return {float(over_sectors(all)), float(over_sectors(inside)), float(supported[0] / weight),
          float(*std::max_element(supported.begin() + 1, supported.end()) / weight)};
}

void expect_near(const EdgeSupport& found, const EdgeSupport& expected) {
  EXPECT_NEAR(found.log_ratio, expected.log_ratio, 1e-5f * (1 + std::abs(expected.log_ratio)));
  EXPECT_NEAR(found.interior_log_ratio, expected.interior_log_ratio,
              1e-5f * (1 + std::abs(expected.interior_log_ratio)));
  EXPECT_NEAR(found.support, expected.support, 1e-6f);
  EXPECT_NEAR(found.best_displaced, expected.best_displaced, 1e-6f);
}

void expect_oracle(Backend& backend) {
  std::mt19937 rng = test::test_rng();
  const test::SupportCase c = test::support_case(rng, 30, 300);
  const std::vector<ViewHandle> views = c.views(backend);
  const std::vector<EdgeSupport> found = c.run(backend, views);
  float largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE("problem " + std::to_string(i));
    const OracleView view{c.pictures[c.problems[i].view]};
    expect_near(found[i], oracle(view, c.points_of(c.problems[i])));
    largest = std::max(largest, found[i].support);
  }
  EXPECT_GT(largest, 0.05f);
}

// A bright disc on dark ground, or no contrast at all.
test::Picture disc(int radius, int brightness) {
  test::Picture picture{121, 121, {}};
  for (int y = 0; y < 121; ++y)
    for (int x = 0; x < 121; ++x)
      picture.pixels.push_back(
          static_cast<std::uint8_t>(std::hypot(x - 60, y - 60) < radius ? 40 + brightness : 40));
  return picture;
}

// A circle's outline: one observation every 6 degrees.
std::vector<SupportPoint> circle(int radius, std::uint8_t first_part) {
  std::vector<SupportPoint> points;
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::numbers::pi * i / 60;
    points.push_back({static_cast<std::uint16_t>(std::lround(60 + radius * std::cos(angle))),
                      static_cast<std::uint16_t>(std::lround(60 + radius * std::sin(angle))), 1024,
                      static_cast<std::uint8_t>(std::lround(angle * 32 / std::numbers::pi) % 32),
                      static_cast<std::uint8_t>(first_part + i / 5)});
  }
  return points;
}

EdgeSupport support_of(Backend& backend, const test::Picture& picture,
                       const std::vector<SupportPoint>& points) {
  const test::SupportCase c{{picture}, points, {{0, std::uint32_t(points.size()), 0}}};
  return c.run(backend, c.views(backend))[0];
}

void expect_known_answers(Backend& backend) {
  const EdgeSupport right = support_of(backend, disc(30, 100), circle(30, 0));
  EXPECT_EQ(right.support, 1);
  EXPECT_LT(right.best_displaced, 0.4f);
  EXPECT_GT(right.log_ratio, 60 * 1.5f) << "more than 1.5 nats an observation";
  EXPECT_EQ(right.interior_log_ratio, 0) << "no interior edges";
  const EdgeSupport inside = support_of(backend, disc(30, 100), circle(30, 12));
  EXPECT_EQ(inside.interior_log_ratio, inside.log_ratio);
  EXPECT_LT(inside.log_ratio, right.log_ratio);
  const EdgeSupport wrong = support_of(backend, disc(30, 100), circle(45, 0));
  EXPECT_LT(wrong.support, 0.1f);
  EXPECT_LT(wrong.log_ratio, -10);
  EXPECT_GE(wrong.log_ratio, 12 * std::log(0.2f)) << "a sector may be hidden";
}

void expect_no_support_without_contrast(Backend& backend) {
  const EdgeSupport flat = support_of(backend, disc(30, 0), circle(30, 0));
  EXPECT_EQ(flat.support, 0);
  EXPECT_EQ(flat.best_displaced, 0);
  // Each sector misses five observations where chance gives nothing.
  const double missed = 5 * std::round(64 * std::log(0.15 / (1 - 1 / 32.0))) / 64;
  EXPECT_NEAR(flat.log_ratio, 12 * std::log(0.8 * std::exp(missed) + 0.2), 1e-4);
  EXPECT_EQ(flat.interior_log_ratio, 0);
}

class EdgeSupportOracle : public test::PathTest {};

TEST_P(EdgeSupportOracle, AgreesWithTheProse) { expect_oracle(*tested); }
TEST_P(EdgeSupportOracle, KnownAnswers) { expect_known_answers(*tested); }
TEST_P(EdgeSupportOracle, NoContrast) { expect_no_support_without_contrast(*tested); }

INSTANTIATE_TEST_SUITE_P(Paths, EdgeSupportOracle, test::all_paths, test::param_name);

TEST(EdgeSupportOracleOfReference, AgreesWithTheProse) { expect_oracle(*make_reference_backend()); }
TEST(EdgeSupportOracleOfReference, KnownAnswers) {
  expect_known_answers(*make_reference_backend());
}
TEST(EdgeSupportOracleOfReference, NoContrast) {
  expect_no_support_without_contrast(*make_reference_backend());
}

}  // namespace
}  // namespace edgescout
