// The tensor against brute force written from dcd_tensor.h's prose alone, in integers and long
// double. Of the kernels' code it takes the storage order (TensorShape) and nothing else: an error
// that all paths share, in the seeds, the weights or the step between bins, would show here.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/dcd_tensor.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

constexpr long double pi = std::numbers::pi_v<long double>;

struct PixelOfBin {
  std::int64_t x, y, bin;
};

struct Case {
  int width, height;
  TensorOptions options;
  TensorShape shape() const { return {width, height, options.bins}; }
};

std::string case_name(const Case& c) {
  const TensorOptions& o = c.options;
  return std::to_string(c.width) + "x" + std::to_string(c.height) + "x" + std::to_string(o.bins) +
         " lambda " + std::to_string(o.lambda_px_per_rad) + " variance " +
         std::to_string(o.smoothing_variance) + " cap " + std::to_string(o.cap_px);
}

// Float and long double may round such a value to different integers.
bool near_half(long double value) { return std::abs(value - std::floor(value) - 0.5L) < 1e-3L; }

long double bin_position(const EdgePoint& edge, int bins) { return edge.theta_rad * (bins / pi); }

std::int64_t circular_distance(std::int64_t k, std::int64_t j, std::int64_t bins) {
  const std::int64_t apart = std::abs(k - j);
  return std::min(apart, bins - apart);
}

std::vector<PixelOfBin> seeded(std::span<const EdgePoint> edges, const TensorShape& shape) {
  std::vector<PixelOfBin> seeds;
  for (const EdgePoint& edge : edges) {
    const std::int64_t x = std::llround(edge.x_px), y = std::llround(edge.y_px);
    if (x < 0 || y < 0 || x >= shape.width || y >= shape.height) continue;
    const std::int64_t turns = std::llround(bin_position(edge, shape.bins)) % shape.bins;
    seeds.push_back({x, y, (turns + shape.bins) % shape.bins});
  }
  return seeds;
}

std::int64_t cap_units(const TensorOptions& options) {
  return std::llround(256.0L * options.cap_px);
}

std::int64_t step_units(const TensorOptions& options) {
  return std::llround(256 * options.lambda_px_per_rad * pi / options.bins);
}

// 256 times the root of an integer is no half, and long double tells the nearest one from it.
std::int64_t distance_units(std::int64_t squared) {
  return std::llround(256 * std::sqrt(static_cast<long double>(squared)));
}

// D_k at one pixel, for all bins k.
std::vector<std::int64_t> distances(std::int64_t x, std::int64_t y,
                                    std::span<const PixelOfBin> seeds,
                                    const TensorOptions& options) {
  std::vector<std::int64_t> nearest(options.bins, cap_units(options));
  for (const PixelOfBin& s : seeds)
    nearest[s.bin] =
        std::min(nearest[s.bin], distance_units((x - s.x) * (x - s.x) + (y - s.y) * (y - s.y)));
  return nearest;
}

// T_k from D_j: every pair of bins.
std::vector<std::int64_t> joined(std::span<const std::int64_t> distance, std::int64_t step) {
  const std::int64_t bins = std::ssize(distance);
  std::vector<std::int64_t> least(bins, std::numeric_limits<std::int64_t>::max());
  for (std::int64_t k = 0; k < bins; ++k)
    for (std::int64_t j = 0; j < bins; ++j)
      least[k] = std::min(least[k], distance[j] + step * circular_distance(k, j, bins));
  return least;
}

// w_0..w_r: the samples' share of their sum in 1/32768, none a whole step beyond 3 sigma or meeting
// itself around the circle.
std::vector<std::int64_t> gaussian_weights(const TensorOptions& options) {
  const long double variance = options.smoothing_variance;
  std::vector<long double> samples{1};
  for (int d = 1; (d - 1) * (d - 1) < 9 * variance && d < options.bins / 2; ++d)
    samples.push_back(std::exp(-d * d / (2 * variance)));
  long double sum = -1;
  for (const long double sample : samples) sum += 2 * sample;
  std::vector<std::int64_t> weights{32768};
  for (std::size_t d = 1; d < samples.size(); ++d) {
    weights.push_back(std::llround(32768 * samples[d] / sum));
    weights[0] -= 2 * weights[d];
  }
  return weights;
}

// DT3_k from T.
std::int64_t smoothed(std::span<const std::int64_t> value, std::int64_t k,
                      std::span<const std::int64_t> weights) {
  const std::int64_t bins = std::ssize(value);
  std::int64_t sum = weights[0] * value[k];
  for (std::int64_t d = 1; d < std::ssize(weights); ++d)
    sum += weights[d] * (value[(k + d) % bins] + value[(k + bins - d) % bins]);
  return (sum + (1 << 14)) >> 15;
}

std::vector<std::uint16_t> oracle_tensor(std::span<const EdgePoint> edges, const Case& c) {
  const TensorShape shape = c.shape();
  const std::vector<PixelOfBin> seeds = seeded(edges, shape);
  const std::vector<std::int64_t> weights = gaussian_weights(c.options);
  std::vector<std::uint16_t> tensor(shape.size(), static_cast<std::uint16_t>(cap_units(c.options)));
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const std::vector<std::int64_t> value =
          joined(distances(x, y, seeds, c.options), step_units(c.options));
      for (int k = 0; k < shape.bins; ++k)
        tensor[shape.index(x, y, k)] = static_cast<std::uint16_t>(smoothed(value, k, weights));
    }
  return tensor;
}

// Each setting at four levels; the 16 cases (an orthogonal array over the field of four elements,
// whose sum is the exclusive or) hold every pair of levels of any two settings once.
std::vector<Case> all_pairs_of_settings() {
  constexpr int widths[] = {1, 7, 33, 31}, heights[] = {1, 5, 17, 50};
  constexpr int bins[] = {4, 6, 60, 128};
  constexpr float lambdas[] = {0, 2, 100, 10000}, variances[] = {0, 0.25f, 1, 16};
  constexpr float caps[] = {1 / 256.0f, 8, 60, 255};
  constexpr int twice[] = {0, 2, 3, 1}, thrice[] = {0, 3, 1, 2};
  std::vector<Case> cases;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      cases.push_back({widths[a],
                       heights[a],
                       {bins[b], lambdas[a ^ b], variances[a ^ twice[b]], caps[a ^ thrice[b]]}});
  // The outermost weight, 9 of 32768, shows where neighbouring bins differ by much.
  cases.push_back({33, 17, {60, 100, 0.25f, 255}});
  return cases;
}

// Positions in 1/8 px, so that half-way ones are among them, up to 2 px outside; angles of any turn
// but those about half-way between two bins.
std::vector<EdgePoint> scattered_edges(std::mt19937& rng, const Case& c) {
  std::uniform_int_distribution<int> x(-16, 8 * c.width + 16), y(-16, 8 * c.height + 16);
  std::uniform_real_distribution<float> theta(-4, 8);
  const int count = 3 + c.width * c.height / 25;
  std::vector<EdgePoint> edges;
  while (static_cast<int>(edges.size()) < count) {
    const EdgePoint edge{static_cast<float>(x(rng)) / 8, static_cast<float>(y(rng)) / 8, theta(rng),
                         10};
    if (!near_half(bin_position(edge, c.options.bins))) edges.push_back(edge);
  }
  return edges;
}

std::vector<std::uint16_t> tensor_of(Backend& backend, std::span<const EdgePoint> edges,
                                     const Case& c) {
  return backend.make_view(edges, c.width, c.height, {}, {}, c.options)->tensor();
}

void expect_equal(Backend& backend, std::span<const EdgePoint> edges, const Case& c) {
  SCOPED_TRACE(case_name(c));
  const std::vector<std::uint16_t> expected = oracle_tensor(edges, c),
                                   found = tensor_of(backend, edges, c);
  ASSERT_EQ(found.size(), expected.size());
  const auto [first, instead] = std::ranges::mismatch(found, expected);
  if (first != found.end())
    ADD_FAILURE() << "at " << first - found.begin() << ": found " << *first << ", expected "
                  << *instead;
}

void expect_brute_force(Backend& backend) {
  std::mt19937 rng = test::test_rng();
  std::vector<Case> cases = all_pairs_of_settings();
  cases.push_back({70, 100, {}});  // more bands and tiles than the others
  for (const Case& c : cases) expect_equal(backend, scattered_edges(rng, c), c);
}

// Hand-rounded: half-way positions go away from zero, angles wrap at pi.
void expect_seeds_round(Backend& backend) {
  struct Rounding {
    EdgePoint edge;
    int x, y, bin;  // bin -1: outside
  };
  const Case c{33, 17, {60, 100, 0, 60}};
  const float degree = std::numbers::pi_v<float> / 180;  // a bin is 3 degrees
  for (const Rounding& r : std::vector<Rounding>{{{0.5f, 1.49f, 0}, 1, 1, 0},
                                                 {{-0.49f, 2.5f, 45 * degree}, 0, 3, 15},
                                                 {{-0.5f, 3, 0}, 0, 0, -1},
                                                 {{3, -0.5f, 0}, 0, 0, -1},
                                                 {{32.49f, 16.49f, 1.4f * degree}, 32, 16, 0},
                                                 {{32.5f, 3, 0}, 0, 0, -1},
                                                 {{3, 16.5f, 0}, 0, 0, -1},
                                                 {{4, 5, 1.6f * degree}, 4, 5, 1},
                                                 {{4, 5, 178.4f * degree}, 4, 5, 59},
                                                 {{4, 5, 178.6f * degree}, 4, 5, 0},
                                                 {{4, 5, 184 * degree}, 4, 5, 1},
                                                 {{4, 5, -4 * degree}, 4, 5, 59}}) {
    SCOPED_TRACE("edge at " + std::to_string(r.edge.x_px) + ", " + std::to_string(r.edge.y_px) +
                 ", angle " + std::to_string(r.edge.theta_rad));
    const std::vector<std::uint16_t> tensor = tensor_of(backend, {&r.edge, 1}, c);
    EXPECT_EQ(std::ranges::count(tensor, 0), r.bin < 0 ? 0 : 1);
    if (r.bin < 0) continue;
    EXPECT_EQ(tensor[c.shape().index(r.x, r.y, r.bin)], 0);
  }
}

// Of a single edge point the tensor is its distance plus the turn, up to the cap. A bin is 256 * 30
// * pi / 60 = 402.1 units.
void expect_single_seed(Backend& backend) {
  const Case c{33, 17, {60, 30, 0, 60}};
  const EdgePoint edge{10, 8, std::numbers::pi_v<float> / 60 * 57, 10};
  const std::vector<std::uint16_t> tensor = tensor_of(backend, {&edge, 1}, c);
  const auto at = [&](int x, int y, int bin) { return tensor[c.shape().index(x, y, bin)]; };
  EXPECT_EQ(at(10, 8, 57), 0);
  EXPECT_EQ(at(13, 12, 57), 5 * 256);
  EXPECT_EQ(at(11, 9, 57), 362);       // 256 * 1.41421 = 362.04
  EXPECT_EQ(at(12, 7, 57), 572);       // 256 * 2.23607 = 572.43
  EXPECT_EQ(at(32, 8, 57), 22 * 256);  // in another tile
  EXPECT_EQ(at(10, 8, 59), 2 * 402);
  EXPECT_EQ(at(10, 8, 0), 3 * 402);    // past the last bin
  EXPECT_EQ(at(10, 8, 27), 30 * 402);  // at right angles
  EXPECT_EQ(at(10, 8, 26), 29 * 402);  // and round the other way
  EXPECT_EQ(at(13, 12, 2), 5 * 256 + 5 * 402);
  EXPECT_EQ(at(32, 8, 27), 60 * 256);  // 69 px: the cap
}

// Where turning costs the cap, T is 0 in the seed's bin and the cap in all others: what is missing
// from the cap is the weight. exp(-d^2 / 2) = 1, 0.606531, 0.135335, 0.011109 sums to 2.505950 over
// both sides, which makes 7930.96, 1769.63 and 145.26 of 32768; the centre takes what remains of
// it.
void expect_hand_computed_weights(Backend& backend) {
  const Case c{3, 3, {60, 10000, 1, 128}};
  const EdgePoint edge{1, 1, 0, 10};
  const std::vector<std::uint16_t> tensor = tensor_of(backend, {&edge, 1}, c);
  const int by_bin[] = {13076, 7931, 1770, 145, 0};
  for (const int turn : {-4, -3, -2, -1, 0, 1, 2, 3, 4})
    EXPECT_EQ(tensor[c.shape().index(1, 1, (turn + 60) % 60)], 32768 - by_bin[std::abs(turn)])
        << "turn " << turn;
}

void expect_known_answers(Backend& backend) {
  expect_seeds_round(backend);
  expect_single_seed(backend);
  expect_hand_computed_weights(backend);
}

class DcdTensorOracle : public test::PathTest {};

TEST_P(DcdTensorOracle, EqualsBruteForce) { expect_brute_force(*tested); }
TEST_P(DcdTensorOracle, KnownAnswers) { expect_known_answers(*tested); }

INSTANTIATE_TEST_SUITE_P(Paths, DcdTensorOracle, test::all_paths, test::param_name);

TEST(DcdTensorOracleOfReference, EqualsBruteForce) {
  expect_brute_force(*make_reference_backend());
}
TEST(DcdTensorOracleOfReference, KnownAnswers) { expect_known_answers(*make_reference_backend()); }

}  // namespace
}  // namespace edgescout
