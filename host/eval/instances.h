// Internal to host/eval: compares the estimates of one object in one image with its true poses.
#pragma once

#include <map>
#include <vector>

#include "host/eval/recall.h"

namespace edgescout {

// Errors are [estimate][truth], estimates of the best score first.
struct Instances {
  int object_id = 0;
  int truths = 0;
  std::vector<double> scores;    // of the estimates
  std::vector<char> is_visible;  // per truth: seen enough
  std::vector<char> counts;      // per truth: to be found; differs where there are targets
  std::vector<double> mssd;      // of the diameter
  std::vector<double> mspd;      // px
  // By tau, of as many of the best estimates as there are truths; empty: not computed.
  std::array<std::vector<double>, VSD_TAUS> vsd;
  std::vector<double> raw, symmetric;  // largest of angle and distance, each over its bound
  double px_per_step = 0;              // of the thresholds of MSPD
  int counting() const;
  int estimates() const { return static_cast<int>(scores.size()); }
};

// One for each object that the image holds or for which it has estimates. Without `of_poses`, `raw`
// and `symmetric` stay empty. InputError: an object that is not in `objects`.
std::vector<Instances> instances_of(const EvaluationImage& image,
                                    const std::map<int, Object>& objects,
                                    const RecallOptions& options, bool of_poses);

}  // namespace edgescout
