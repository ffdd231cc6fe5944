#include "host/eval/matching.h"

namespace edgescout {

std::vector<int> match_in_order(std::span<const double> errors, int truths, double threshold) {
  std::vector<int> matched;
  std::vector<char> taken(static_cast<std::size_t>(truths), 0);
  for (; truths > 0 && !errors.empty(); errors = errors.subspan(taken.size())) {
    int best = UNMATCHED;
    double least = threshold;
    for (int t = 0; t < truths; ++t)
      if (const double error = errors[static_cast<std::size_t>(t)]; !taken[t] && error < least)
        best = t, least = error;
    if (best != UNMATCHED) taken[best] = 1;
    matched.push_back(best);
  }
  return matched;
}

}  // namespace edgescout
