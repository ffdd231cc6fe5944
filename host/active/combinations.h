// Hypothetical scenes: subsets of the object candidates that can exist together (paper, Sec. 5.2, Algorithm
// 1).
#pragma once

#include <cstdint>
#include <span>

#include "host/core/bit_matrix.h"

namespace edgescout {

struct CombinationOptions {
  int count = 1000;
  std::uint64_t seed = 1;
  // a: candidates are drawn with p ~ exp(-a (1 - psi)^2); 1 is the paper's, hardly less than flat
  double sharpness = 1;
  void validate() const;
};

// Algorithm 1: for each combination K ~ Bin(N, 0.5), then K draws without replacement; a candidate that
// clashes with one drawn before is left out and costs its draw. Rows are draws: the same scene drawn twice
// stands there twice, and a scene without objects may be among them. Where all pairs clash each row has one
// candidate or none. InputError where there is no candidate.
BitMatrix sample_combinations(std::span<const double> psi, const BitMatrix& plausible,
                              const CombinationOptions& options);

}  // namespace edgescout
