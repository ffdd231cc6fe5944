// Computes true positives against false positives for all thresholds of a score (the paper's first
// experiment).
#pragma once

#include <cstdint>
#include <vector>

namespace edgescout {

// A pose with its score; higher is likelier. `instance`: the true instance that it is a pose of;
// -1: none.
struct ScoredPose {
  double score = 0;
  int instance = -1;
  int image = 0;
};

// The result of accepting all poses of at least one score.
struct CurvePoint {
  int false_positives = 0;
  int found = 0;  // instances with at least one accepted pose; further poses of it are not counted
  double rate = 0;  // found / instances
};

// Returns one point per score that occurs, from the highest down. Poses of equal score are accepted
// at once. The first point accepts nothing. `instances`: the number of true instances, scored or
// not.
std::vector<CurvePoint> detection_curve(std::vector<ScoredPose> poses, int instances);

// Returns the highest rate with at most so many false positives.
double rate_at(const std::vector<CurvePoint>& curve, double false_positives);

// A bootstrap over images: for every draw, how often each image is in it.
using Draws = std::vector<std::vector<int>>;
Draws draw_images(std::size_t images, int draws = 2000, std::uint64_t seed = 1);

// Returns rate_at() for the curve over the images of each draw, with at most so many false
// positives per image. `instances`: per image. Draws without any instance are left out.
std::vector<double> resampled_rates(std::vector<ScoredPose> poses,
                                    const std::vector<int>& instances,
                                    double false_positives_per_image, const Draws& draws);

}  // namespace edgescout
