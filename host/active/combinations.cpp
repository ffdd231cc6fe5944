#include "host/active/combinations.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>

#include "host/core/order.h"
#include "host/core/random.h"
#include "host/detect/plausible_pairs.h"
#include "host/register/pose_estimate.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// A draw from Bin(n, 0.5): the number of ones among n random bits.
int binomial(std::size_t n, Random& random) {
  int ones = 0;
  for (; n >= 64; n -= 64) ones += std::popcount(random.bits());
  return n == 0 ? ones : ones + std::popcount(random.bits() >> (64 - n));
}

// A random order of the candidates: each next one is drawn with probability proportional to its
// weight among the rest. Equal to the order of exponential waiting times, one per candidate, with
// the weights as rates (Efraimidis & Spirakis 2006).
void draw_order(std::span<const double> weights, Random& random, std::vector<double>& waits,
                std::vector<std::size_t>& order) {
  for (std::size_t i = 0; i < weights.size(); ++i)
    waits[i] = -std::log(1 - random.uniform()) / weights[i];
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return waits[i]; });
}

std::span<const std::uint32_t> row(const BitMatrix& matrix, std::size_t index) {
  return std::span(matrix.words).subspan(index * matrix.row_words(), matrix.row_words());
}

// Whether the candidate collides with no member of a combination.
bool fits_into(std::span<const std::uint32_t> members, std::size_t candidate,
               const BitMatrix& plausible) {
  const std::span<const std::uint32_t> compatible = row(plausible, candidate);
  for (std::size_t w = 0; w < members.size(); ++w)
    if (members[w] & ~compatible[w]) return false;
  return true;
}

void check_input(std::size_t candidates, const BitMatrix& plausible,
                 const CombinationOptions& options) {
  options.validate();
  if (candidates == 0)
    throw InputError("combinations", "candidates", "none", "at least one object candidate");
  check(plausible.rows == candidates && plausible.columns == candidates,
        "combinations: plausible pairs of as many candidates");
}

}  // namespace

void describe(CombinationOptions& o, OptionVisitor& visit) {
  visit.group("Information");
  visit.number({"combinations", "Number of combinations that are sampled for each decision"},
               o.count, 1, 1000000);
}

void describe_ablations(CombinationOptions& o, OptionVisitor& visit) {
  visit.number({"sharpness",
                "Preference for candidates of high psi where combinations are sampled by psi, "
                "without unit. 1: as in the paper"},
               o.sharpness, 0.0, 500.0);
}

void CombinationOptions::validate() const {
  CombinationOptions copy = *this;
  BoundsCheck in("scout");
  describe(copy, in);
  describe_ablations(copy, in);
}

BitMatrix sample_combinations(std::span<const double> psi, const BitMatrix& plausible,
                              const CombinationOptions& options) {
  const std::size_t candidates = psi.size();
  check_input(candidates, plausible, options);
  std::vector<double> weights;
  for (const double score : psi) {
    check(score >= 0 && score <= 1, "sample_combinations: psi in [0, 1]");
    weights.push_back(std::exp(-options.sharpness * (1 - score) * (1 - score)));
  }
  BitMatrix combinations(options.count, candidates);
  Random random = Random(options.seed).split("combinations");
  std::vector<double> waits(candidates);
  std::vector<std::size_t> order(candidates);
  for (int j = 0; j < options.count; ++j) {
    const int draws = binomial(candidates, random);
    draw_order(weights, random, waits, order);
    const std::span<const std::uint32_t> members = row(combinations, j);
    for (int k = 0; k < draws; ++k)
      if (fits_into(members, order[k], plausible)) combinations.set(j, order[k]);
  }
  return combinations;
}

BitMatrix sample_probable_combinations(std::span<const double> probabilities,
                                       const BitMatrix& plausible,
                                       const CombinationOptions& options) {
  constexpr double least = 0.02;  // probability of presence and of absence: none is certain
  const std::size_t candidates = probabilities.size();
  check_input(candidates, plausible, options);
  for (const double p : probabilities)
    check(p >= 0 && p <= 1, "sample_probable_combinations: probabilities in [0, 1]");
  const std::vector<std::size_t> order = largest_first(probabilities);
  BitMatrix combinations(options.count, candidates);
  Random random = Random(options.seed).split("probable combinations");
  for (int j = 0; j < options.count; ++j) {
    const std::span<const std::uint32_t> members = row(combinations, j);
    for (const std::size_t c : order)
      if (random.uniform() < std::clamp(probabilities[c], least, 1 - least) &&
          fits_into(members, c, plausible))
        combinations.set(j, c);
  }
  return combinations;
}

BitMatrix candidate_combinations(std::span<const EdgeModel> models,
                                 std::span<const Detection> candidates, bool by_probability,
                                 double penetration_m, const CombinationOptions& options,
                                 ThreadPool& threads) {
  std::vector<double> psi, probabilities;
  for (const Detection& candidate : candidates) {
    psi.push_back(candidate.psi);
    probabilities.push_back(candidate.probability);
  }
  const BitMatrix plausible =
      plausible_pairs(models, object_poses(candidates), penetration_m, threads);
  return by_probability ? sample_probable_combinations(probabilities, plausible, options)
                        : sample_combinations(psi, plausible, options);
}

CombinationExtremes extreme_combinations(const BitMatrix& combinations,
                                         std::span<const double> probabilities) {
  check(combinations.columns == probabilities.size(),
        "extreme_combinations: a probability a candidate");
  CombinationExtremes extremes;
  double most = -INFINITY, least = INFINITY;
  for (std::size_t row = 0; row < combinations.rows; ++row) {
    std::vector<int> members;
    double log_probability = 0;
    for (std::size_t c = 0; c < probabilities.size(); ++c) {
      const double p = std::clamp(probabilities[c], 0.001, 0.999);
      log_probability += std::log(combinations.has(row, c) ? p : 1 - p);
      if (combinations.has(row, c)) members.push_back(static_cast<int>(c));
    }
    if (log_probability > most) most = log_probability, extremes.likeliest = members;
    if (log_probability < least) least = log_probability, extremes.unlikeliest = members;
  }
  return extremes;
}

}  // namespace edgescout
