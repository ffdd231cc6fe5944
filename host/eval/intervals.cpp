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

Interval bootstrap_interval(std::span<const Cluster> clusters, int resamples, std::uint64_t seed) {
  if (clusters.size() < 2)
    return clusters.empty() ? Interval{} : wilson_interval(clusters[0].hits, clusters[0].trials);
  Random random(seed);
  std::vector<double> rates;
  std::vector<Cluster> drawn(clusters.size());
  for (int i = 0; i < resamples; ++i) {
    for (Cluster& cluster : drawn) cluster = clusters[random.below(static_cast<int>(clusters.size()))];
    rates.push_back(rate(drawn));
  }
  std::ranges::sort(rates);
  const auto at = [&](double quantile) {
    return rates[static_cast<std::size_t>(std::lround(quantile * (resamples - 1)))];
  };
  return {at(0.025), at(0.975)};
}

}  // namespace edgescout
