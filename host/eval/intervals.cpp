#include "host/eval/intervals.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/core/random.h"

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
    return values[static_cast<std::size_t>(std::lround(quantile * static_cast<double>(values.size() - 1)))];
  };
  return {at(0.025), at(0.975)};
}

Interval resampled_interval(std::vector<double> rates, double clusters) {
  constexpr double ROUNDING = 1e-12;
  if (rates.empty()) return {};
  const auto [least, most] = std::ranges::minmax(rates);
  if (most - least < ROUNDING && most <= 1 + ROUNDING)
    return wilson_interval(std::min(1.0, most) * clusters, clusters);
  return percentile_interval(std::move(rates));
}

Interval bootstrap_interval(std::span<const Cluster> clusters, int resamples, std::uint64_t seed) {
  std::vector<Cluster> with_trials(clusters.begin(), clusters.end());
  std::erase_if(with_trials, [](const Cluster& cluster) { return cluster.trials <= 0; });
  if (with_trials.empty()) return {};
  Random random(seed);
  std::vector<double> rates;
  std::vector<Cluster> drawn(with_trials.size());
  for (int i = 0; i < resamples; ++i) {
    for (Cluster& cluster : drawn) cluster = with_trials[random.below(static_cast<int>(with_trials.size()))];
    rates.push_back(rate(drawn));
  }
  return resampled_interval(std::move(rates), static_cast<double>(with_trials.size()));
}

}  // namespace edgescout
