// Hypothetical scenes: subsets of the object candidates that can exist together (paper, Sec. 5.2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/core/bit_matrix.h"
#include "host/core/types.h"
#include "host/model/edge_model.h"

namespace edgescout {

class ThreadPool;

struct CombinationOptions {
  int count = 1000;
  std::uint64_t seed = 1;
  // a of Algorithm 1: candidates are drawn with p ~ exp(-a (1 - psi)^2); 1 is the paper's, hardly
  // less than flat
  double sharpness = 1;
  void validate() const;
};

// Algorithm 1: for each combination K ~ Bin(N, 0.5), then K draws without replacement; a candidate
// that clashes with one drawn before is left out and costs its draw. Rows are draws: the same scene
// drawn twice stands there twice, and a scene without objects may be among them. Where all pairs
// clash each row has one candidate or none. InputError where there is no candidate.
BitMatrix sample_combinations(std::span<const double> psi, const BitMatrix& plausible,
                              const CombinationOptions& options);

// Scenes as often as they are believed in: each candidate is there with its own probability, the
// more probable ones first, and not where it clashes with one that is there. What is known stands
// in nearly every scene, so that a view of it is expected to tell little, and hides what it hides;
// Algorithm 1 has every candidate in about half of them, however well it is known. None is surer to
// be there or not than 98 %. Rows, `count` and `seed` as above. InputError where there is no
// candidate.
BitMatrix sample_probable_combinations(std::span<const double> probabilities,
                                       const BitMatrix& plausible,
                                       const CombinationOptions& options);

// The scenes that a decision imagines of refined candidates (world): by their probability, or by
// psi as in Algorithm 1. Two of which one reaches more than `penetration_m` into the other exclude
// each other.
BitMatrix candidate_combinations(std::span<const EdgeModel> models,
                                 std::span<const Detection> candidates, bool by_probability,
                                 double penetration_m, const CombinationOptions& options,
                                 ThreadPool& threads);

// The most and the least probable of the rows, each candidate being there or not by its own
// probability; of equal ones the first. Empty where there is no row.
struct CombinationExtremes {
  std::vector<int> likeliest, unlikeliest;  // indices of candidates, rising
};
CombinationExtremes extreme_combinations(const BitMatrix& combinations,
                                         std::span<const double> probabilities);

}  // namespace edgescout
