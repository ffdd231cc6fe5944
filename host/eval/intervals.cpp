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

Interval bootstrap_interval(std::span<const Cluster> clusters, int resamples, std::uint64_t seed) {
  std::vector<Cluster> with_trials(clusters.begin(), clusters.end());
  std::erase_if(with_trials, [](const Cluster& cluster) { return cluster.trials <= 0; });
  const auto has_first_rate = [&](const Cluster& cluster) {
    return cluster.hits * with_trials[0].trials == with_trials[0].hits * cluster.trials;
  };
  if (std::ranges::all_of(with_trials, has_first_rate))
    return wilson_interval(rate(with_trials) * static_cast<double>(with_trials.size()),
                           static_cast<double>(with_trials.size()));
  Random random(seed);
  std::vector<double> rates;
  std::vector<Cluster> drawn(with_trials.size());
  for (int i = 0; i < resamples; ++i) {
    for (Cluster& cluster : drawn) cluster = with_trials[random.below(static_cast<int>(with_trials.size()))];
    rates.push_back(rate(drawn));
  }
  return percentile_interval(std::move(rates));
}

}  // namespace edgescout
