// True positives against false positives, over all thresholds of a score (the paper's first experiment).
#pragma once

#include <vector>

namespace edgescout {

// A pose that was scored; the higher, the likelier. `instance`: the true instance it is a pose of, -1 for
// none.
struct ScoredPose {
  double score = 0;
  int instance = -1;
};

// What is accepted from one score up.
struct CurvePoint {
  int false_positives = 0;
  int found = 0;    // instances with at least one accepted pose; further poses of an instance count nowhere
  double rate = 0;  // found / instances
};

// One point for every score that occurs, from the highest down: poses of equal score are accepted together.
// Begins with nothing accepted. `instances`: how many there are, scored or not.
std::vector<CurvePoint> detection_curve(std::vector<ScoredPose> poses, int instances);

// The highest rate with at most so many false positives.
double rate_at(const std::vector<CurvePoint>& curve, double false_positives);

}  // namespace edgescout
