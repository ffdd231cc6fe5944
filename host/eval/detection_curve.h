// True positives against false positives, over all thresholds of a score (the paper's first
// experiment).
#pragma once

#include <cstdint>
#include <vector>

namespace edgescout {

// A pose that was scored; the higher, the likelier. `instance`: the true instance it is a pose of,
// -1 for none.
struct ScoredPose {
  double score = 0;
  int instance = -1;
  int image = 0;
};

// What is accepted from one score up.
struct CurvePoint {
  int false_positives = 0;
  int found =
      0;  // instances with at least one accepted pose; further poses of an instance count nowhere
  double rate = 0;  // found / instances
};

// One point for every score that occurs, from the highest down: poses of equal score are accepted
// together. Begins with nothing accepted. `instances`: how many there are, scored or not.
std::vector<CurvePoint> detection_curve(std::vector<ScoredPose> poses, int instances);

// The highest rate with at most so many false positives.
double rate_at(const std::vector<CurvePoint>& curve, double false_positives);

// A bootstrap over images: of every draw how often each image is in it.
using Draws = std::vector<std::vector<int>>;
Draws draw_images(std::size_t images, int draws = 2000, std::uint64_t seed = 1);

// rate_at() of the curve over each draw's images, with at most so many false positives an image.
// `instances` by image. Draws without any instance are left out.
std::vector<double> resampled_rates(std::vector<ScoredPose> poses,
                                    const std::vector<int>& instances,
                                    double false_positives_per_image, const Draws& draws);

}  // namespace edgescout
