// Computes confidence intervals of measured rates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace edgescout {

struct Interval {
  double low = 0, high = 1;
};

// Wilson's score interval for `hits` in `trials` independent trials and a normal deviate of z
// (1.96: 95 %). [0, 1] without trials.
Interval wilson_interval(double hits, double trials, double z = 1.96);

// Trials that are not independent: the starts in one image, the instances of one bin.
struct Cluster {
  double hits = 0, trials = 0;
};

// The rate over all clusters; 0 without trials.
double rate(std::span<const Cluster> clusters);

// The interval that contains 95 % of the values; [0, 1] without values.
Interval percentile_interval(std::vector<double> values);

// The same for a rate that was resampled over so many clusters. If 95 % of the values are equal,
// they show no spread. Then it is Wilson's interval with each cluster as one trial, or the value
// itself if it is above 1 (a mean number, no rate).
Interval resampled_interval(std::vector<double> rates, double clusters);

// Percentile bootstrap of `rate` over clusters: the clusters are drawn with replacement,
// `resamples` times. The interval is that of resampled_interval(). [0, 1] without trials.
Interval bootstrap_interval(std::span<const Cluster> clusters, int resamples = 2000,
                            std::uint64_t seed = 1);

// The interval of rate(a) - rate(b) for two methods on the same clusters in the same order:
// percentiles over draws that both share. [-1, 1] without trials.
Interval paired_difference_interval(std::span<const Cluster> a, std::span<const Cluster> b,
                                    int resamples = 2000, std::uint64_t seed = 1);

}  // namespace edgescout
