#include "host/eval/intervals.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "host/core/random.h"
#include "kernels/error.h"

namespace edgescout {

Interval wilson_interval(double hits, double trials, double z) {
  if (trials <= 0) return {};
  const double p = hits / trials, spread = z * z / trials;
  const double middle = (p + spread / 2) / (1 + spread);
  const double half = std::sqrt(p * (1 - p) * spread + spread * spread / 4) / (1 + spread);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

double rate(std::span<const Cluster> clusters) {
  double hits = 0, trials = 0;
  for (const Cluster& cluster : clusters) hits += cluster.hits, trials += cluster.trials;
  return trials > 0 ? hits / trials : 0;
}

Interval percentile_interval(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto at = [&](double quantile) {
    return values[static_cast<std::size_t>(
        std::lround(quantile * static_cast<double>(values.size() - 1)))];
  };
  return {at(0.025), at(0.975)};
}

Interval resampled_interval(std::vector<double> rates, double clusters) {
  constexpr double ROUNDING = 1e-12;
  if (rates.empty()) return {};
  const Interval interval = percentile_interval(std::move(rates));
  if (interval.high - interval.low < ROUNDING && interval.high <= 1 + ROUNDING)
    return wilson_interval(std::min(1.0, interval.high) * clusters, clusters);
  return interval;
}

Interval bootstrap_interval(std::span<const Cluster> clusters, int resamples, std::uint64_t seed) {
  std::vector<Cluster> with_trials(clusters.begin(), clusters.end());
  std::erase_if(with_trials, [](const Cluster& cluster) { return cluster.trials <= 0; });
  if (with_trials.empty()) return {};
  Random random(seed);
  std::vector<double> rates;
  std::vector<Cluster> drawn(with_trials.size());
  for (int i = 0; i < resamples; ++i) {
    for (Cluster& cluster : drawn)
      cluster = with_trials[random.below(static_cast<int>(with_trials.size()))];
    rates.push_back(rate(drawn));
  }
  return resampled_interval(std::move(rates), static_cast<double>(with_trials.size()));
}

Interval paired_difference_interval(std::span<const Cluster> a, std::span<const Cluster> b,
                                    int resamples, std::uint64_t seed) {
  check(a.size() == b.size(), "paired_difference_interval: the same clusters");
  std::vector<std::pair<Cluster, Cluster>> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    check(a[i].trials == b[i].trials, "paired_difference_interval: the same trials");
    if (a[i].trials > 0) pairs.emplace_back(a[i], b[i]);
  }
  if (pairs.empty()) return {-1, 1};
  Random random(seed);
  std::vector<double> differences;
  std::vector<Cluster> drawn_a(pairs.size()), drawn_b(pairs.size());
  for (int i = 0; i < resamples; ++i) {
    for (std::size_t k = 0; k < pairs.size(); ++k)
      std::tie(drawn_a[k], drawn_b[k]) = pairs[random.below(static_cast<int>(pairs.size()))];
    differences.push_back(rate(drawn_a) - rate(drawn_b));
  }
  return percentile_interval(std::move(differences));
}

}  // namespace edgescout
