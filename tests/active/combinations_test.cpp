#include "host/active/combinations.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>

#include "tests/io/expect_input_error.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

BitMatrix all_compatible(std::size_t count) {
  BitMatrix pairs(count, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) pairs.set(i, j);
  return pairs;
}

BitMatrix all_colliding(std::size_t count) {
  BitMatrix pairs(count, count);
  for (std::size_t i = 0; i < count; ++i) pairs.set(i, i);
  return pairs;
}

std::uint32_t row_of(const BitMatrix& m, std::size_t row) {
  std::uint32_t set = 0;
  for (std::size_t c = 0; c < m.columns; ++c) set |= std::uint32_t(m.has(row, c)) << c;
  return set;
}

// Probability of every outcome of Algorithm 1, by following every sequence of draws.
void follow(const std::vector<double>& weights, const BitMatrix& plausible, int draws,
            std::uint32_t drawn, std::uint32_t set, double probability,
            std::map<std::uint32_t, double>& outcome) {
  if (draws == 0) {
    outcome[set] += probability;
    return;
  }
  double total = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (!(drawn >> i & 1)) total += weights[i];
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (drawn >> i & 1) continue;
    bool fits = true;
    for (std::size_t m = 0; m < weights.size(); ++m) fits &= !(set >> m & 1) || plausible.has(i, m);
    follow(weights, plausible, draws - 1, drawn | 1u << i, fits ? set | 1u << i : set,
           probability * weights[i] / total, outcome);
  }
}

TEST(SampleCombinations, HasTheDistributionOfAlgorithm1) {
  const std::vector<double> psi{0.95, 0.2, 0.7, 0.5, 0.85};
  BitMatrix plausible = all_colliding(5);
  for (auto [i, j] : {std::pair(0, 2), {1, 2}, {0, 4}, {2, 3}, {3, 4}, {1, 4}})
    plausible.set(i, j), plausible.set(j, i);
  CombinationOptions options;
  options.count = 400000;
  options.sharpness = 3;
  std::vector<double> weights;
  for (double p : psi) weights.push_back(std::exp(-3 * (1 - p) * (1 - p)));
  std::map<std::uint32_t, double> expected;
  for (int k = 0; k <= 5; ++k) {
    const double binomial[] = {1, 5, 10, 10, 5, 1};
    follow(weights, plausible, k, 0, 0, binomial[k] / 32, expected);
  }
  const BitMatrix drawn = sample_combinations(psi, plausible, options);
  std::map<std::uint32_t, double> found;
  for (std::size_t j = 0; j < drawn.rows; ++j) found[row_of(drawn, j)] += 1.0 / options.count;
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [set, probability] : expected)
    EXPECT_NEAR(found[set], probability, 5 * std::sqrt(probability / options.count))
        << std::hex << set;
}

TEST(SampleCombinations, NeverJoinsCollidingCandidates) {
  Random random = test_random();
  const std::size_t count = 70;  // more than two words
  BitMatrix plausible = all_colliding(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (random.uniform() < 0.8) plausible.set(i, j), plausible.set(j, i);
  std::vector<double> psi(count);
  for (double& p : psi) p = random.uniform();
  const BitMatrix drawn = sample_combinations(psi, plausible, {2000, 7, 1});
  int largest = 0;
  for (std::size_t row = 0; row < drawn.rows; ++row) {
    int members = 0;
    for (std::size_t i = 0; i < count; ++i) {
      members += drawn.has(row, i);
      for (std::size_t j = 0; j < i; ++j)
        ASSERT_FALSE(drawn.has(row, i) && drawn.has(row, j) && !plausible.has(i, j));
    }
    largest = std::max(largest, members);
  }
  EXPECT_GT(largest, 6);
}

TEST(SampleCombinations, DependsOnTheSeedAlone) {
  const std::vector<double> psi(40, 0.8);
  const BitMatrix a = sample_combinations(psi, all_compatible(40), {100, 3, 1}),
                  b = sample_combinations(psi, all_compatible(40), {100, 3, 1});
  EXPECT_EQ(a.words, b.words);
  EXPECT_NE(a.words, sample_combinations(psi, all_compatible(40), {100, 4, 1}).words);
}

TEST(SampleCombinations, SharpnessPrefersTheGood) {
  std::vector<double> psi(20, 0.5);
  psi[3] = 0.95;
  const auto share = [&](double sharpness) {
    const BitMatrix drawn = sample_combinations(psi, all_colliding(20), {4000, 1, sharpness});
    double with = 0;
    for (std::size_t j = 0; j < drawn.rows; ++j) with += drawn.has(j, 3);
    return with / drawn.rows;
  };
  EXPECT_NEAR(share(0), 0.05, 0.015);  // all collide: the first draw stays, and all are alike
  EXPECT_NEAR(share(20), std::exp(-0.05) / (std::exp(-0.05) + 19 * std::exp(-5.0)), 0.02);
}

// All pairs collide: combinations of one object remain, and the empty one where nothing was drawn.
TEST(SampleCombinations, AllImplausibleLeavesSingleObjects) {
  const BitMatrix drawn =
      sample_combinations(std::vector<double>(8, 0.9), all_colliding(8), {4000, 1, 1});
  int empty = 0;
  for (std::size_t j = 0; j < drawn.rows; ++j) {
    const int members = std::popcount(row_of(drawn, j));
    ASSERT_LE(members, 1);
    empty += members == 0;
  }
  EXPECT_NEAR(empty / 4000.0, 1 / 256.0, 0.005);
}

// Probability of every combination: each candidate is in it or not, one after the other.
void enumerate(const std::vector<double>& probabilities, const BitMatrix& plausible,
               const std::vector<std::size_t>& order, std::size_t done, std::uint32_t set,
               double probability, std::map<std::uint32_t, double>& outcome) {
  if (done == order.size()) {
    outcome[set] += probability;
    return;
  }
  const std::size_t c = order[done];
  bool fits = true;
  for (std::size_t m = 0; m < order.size(); ++m) fits &= !(set >> m & 1) || plausible.has(c, m);
  const double p = fits ? probabilities[c] : 0;
  enumerate(probabilities, plausible, order, done + 1, set, probability * (1 - p), outcome);
  if (fits)
    enumerate(probabilities, plausible, order, done + 1, set | 1u << c, probability * p, outcome);
}

TEST(SampleProbableCombinations, HasTheProbabilitiesOfTheCandidates) {
  const std::vector<double> probabilities{0.3, 0.9, 0.05, 0.6, 0.5};
  BitMatrix plausible = all_compatible(5);
  for (auto [i, j] : {std::pair(0, 1), {3, 4}})
    plausible.words[i] &= ~(1u << j), plausible.words[j] &= ~(1u << i);
  std::map<std::uint32_t, double> expected, found;
  enumerate(probabilities, plausible, {1, 3, 4, 0, 2}, 0, 0, 1, expected);
  CombinationOptions options;
  options.count = 400000;
  const BitMatrix drawn = sample_probable_combinations(probabilities, plausible, options);
  for (std::size_t j = 0; j < drawn.rows; ++j) found[row_of(drawn, j)] += 1.0 / options.count;
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [set, probability] : expected)
    EXPECT_NEAR(found[set], probability, 5 * std::sqrt(probability / options.count))
        << std::hex << set;
}

// A certain candidate is still left out at times, and an impossible one is still in some.
TEST(SampleProbableCombinations, IsNeverCertain) {
  const BitMatrix drawn =
      sample_probable_combinations(std::vector<double>{0, 1}, all_compatible(2), {20000, 1, 1});
  double first = 0, second = 0;
  for (std::size_t j = 0; j < drawn.rows; ++j) first += drawn.has(j, 0), second += drawn.has(j, 1);
  EXPECT_NEAR(first / drawn.rows, 0.02, 0.005);
  EXPECT_NEAR(second / drawn.rows, 0.98, 0.005);
}

TEST(SampleProbableCombinations, DependsOnTheSeedAlone) {
  const std::vector<double> probabilities(40, 0.5);
  const auto words = [&](std::uint64_t seed) {
    return sample_probable_combinations(probabilities, all_compatible(40), {100, seed, 1}).words;
  };
  EXPECT_EQ(words(3), words(3));
  EXPECT_NE(words(3), words(4));
}

TEST(SampleProbableCombinations, NeedsACandidate) {
  expect_input_error([] { sample_probable_combinations({}, BitMatrix(0, 0), {}); },
                     {"candidates", "none"});
}

TEST(SampleCombinations, NeedsACandidate) {
  expect_input_error([] { sample_combinations({}, BitMatrix(0, 0), {}); }, {"candidates", "none"});
  expect_input_error(
      [] {
        sample_combinations(std::vector<double>{1}, all_compatible(1), {0, 1, 1});
      },
      {"scout.combinations"});
  expect_input_error(
      [] {
        sample_combinations(std::vector<double>{1}, all_compatible(1), {1, 1, -1});
      },
      {"scout.sharpness"});
}

// Probabilities of all eight combinations of three candidates, multiplied out: 0.9 or 0.1, 0.3 or
// 0.7, 0.6 or 0.4.
TEST(ExtremeCombinations, AreTheMostAndTheLeastProbable) {
  const std::vector<double> probabilities{0.9, 0.3, 0.6};
  const auto extremes = [&](std::initializer_list<std::uint32_t> rows) {
    BitMatrix combinations(rows.size(), 3);
    std::copy(rows.begin(), rows.end(), combinations.words.begin());
    return extreme_combinations(combinations, probabilities);
  };
  const CombinationExtremes all = extremes({0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(all.likeliest, (std::vector{0, 2})) << "0.9 * 0.7 * 0.6";
  EXPECT_EQ(all.unlikeliest, (std::vector{1})) << "0.1 * 0.3 * 0.4";
  const CombinationExtremes some = extremes({6, 3, 0, 1});  // 0.018, 0.108, 0.028, 0.252
  EXPECT_EQ(some.likeliest, (std::vector{0}));
  EXPECT_EQ(some.unlikeliest, (std::vector{1, 2}));
  const CombinationExtremes none = extremes({0, 2});
  EXPECT_TRUE(none.likeliest.empty()) << "a combination without objects";
  EXPECT_EQ(none.unlikeliest, (std::vector{1}));
  EXPECT_TRUE(extremes({}).likeliest.empty() && extremes({}).unlikeliest.empty());
}

// A certain candidate and an impossible one leave the decision to the others.
TEST(ExtremeCombinations, HandleCertainCandidates) {
  BitMatrix combinations(3, 3);
  combinations.words = {0b001, 0b101, 0b011};
  const CombinationExtremes extremes =
      extreme_combinations(combinations, std::vector{1.0, 0.0, 0.8});
  EXPECT_EQ(extremes.likeliest, (std::vector{0, 2}));
  EXPECT_EQ(extremes.unlikeliest, (std::vector{0, 1}));
}

}  // namespace
}  // namespace edgescout::test
