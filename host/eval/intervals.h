// How far a measured rate can be trusted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace edgescout {

struct Interval {
  double low = 0, high = 1;
};

// Wilson's score interval of `hits` in `trials` independent ones, for a normal deviate of z (1.96:
// 95 %). [0, 1] without trials.
Interval wilson_interval(double hits, double trials, double z = 1.96);

// What belongs together: the starts in one image, the instances of one bin. They succeed and fail
// together.
struct Cluster {
  double hits = 0, trials = 0;
};

// Of all clusters together; 0 without trials.
double rate(std::span<const Cluster> clusters);

// What holds 95 % of these values; [0, 1] without any.
Interval percentile_interval(std::vector<double> values);

// The same of a rate that was resampled over so many clusters. Where 95 % of the values are alike
// nothing shows a spread: Wilson's interval then, each cluster as one trial (of a mean number above
// 1, which is no rate, the value).
Interval resampled_interval(std::vector<double> rates, double clusters);

// Percentile bootstrap of `rate` over clusters: as many are drawn with replacement, `resamples`
// times; the interval is resampled_interval()'s. [0, 1] without trials.
Interval bootstrap_interval(std::span<const Cluster> clusters, int resamples = 2000,
                            std::uint64_t seed = 1);

// Of rate(a) less rate(b), of two methods on the same clusters in the same order: percentiles over
// draws that both share. [-1, 1] without trials.
Interval paired_difference_interval(std::span<const Cluster> a, std::span<const Cluster> b,
                                    int resamples = 2000, std::uint64_t seed = 1);

}  // namespace edgescout
