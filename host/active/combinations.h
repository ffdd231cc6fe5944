// Combinations: sets of object candidates that can exist together (paper, Sec. 5.2: scene
// realizations).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/core/bit_matrix.h"
#include "host/core/options.h"
#include "host/core/types.h"
#include "host/model/edge_model.h"

namespace edgescout {

class ThreadPool;

struct CombinationOptions {
  int count = 1000;  // of sampled combinations, [1, 1000000]
  std::uint64_t seed = 1;
  // a of Algorithm 1, [0, 500]: candidates are drawn with p ~ exp(-a (1 - psi)^2). 1 is the paper's
  // value, and nearly the same as drawing all alike.
  double sharpness = 1;
  void validate() const;  // InputError naming the field and the violated bound
};

void describe(CombinationOptions& options, OptionVisitor& visit);
void describe_ablations(CombinationOptions& options, OptionVisitor& visit);

// Algorithm 1. Each combination has K ~ Bin(N, 0.5) draws without replacement. A drawn candidate
// that collides with one drawn before is left out, and its draw is used up. Rows are combinations;
// the same one may be drawn twice, and one without objects may be among them. Where all pairs
// collide, each row has one candidate or none. InputError: no candidate, options out of bounds.
BitMatrix sample_combinations(std::span<const double> psi, const BitMatrix& plausible,
                              const CombinationOptions& options);

// Combinations in proportion to their probability. A candidate is in one with its own probability,
// limited to [2 %, 98 %], unless it collides with a more probable candidate that is in it. An
// object that is known is in nearly every combination: a view of it is expected to give little
// information, and it hides what is behind it. In Algorithm 1 every candidate is in about half of
// them, however well it is known. Rows, `count`, `seed` and errors as above.
BitMatrix sample_probable_combinations(std::span<const double> probabilities,
                                       const BitMatrix& plausible,
                                       const CombinationOptions& options);

// The combinations on which a decision is based. `candidates`: refined, in the world. They are
// sampled by probability, or by psi as in Algorithm 1. Two candidates exclude each other where one
// reaches more than `penetration_m` into the other.
BitMatrix candidate_combinations(std::span<const EdgeModel> models,
                                 std::span<const Detection> candidates, bool by_probability,
                                 double penetration_m, const CombinationOptions& options,
                                 ThreadPool& threads);

// The most and the least probable of the rows: a candidate is in a row or not independently of the
// others, by its own probability. The first of equal rows. Empty where there is no row.
struct CombinationExtremes {
  std::vector<int> likeliest, unlikeliest;  // indices of candidates, ascending
};
CombinationExtremes extreme_combinations(const BitMatrix& combinations,
                                         std::span<const double> probabilities);

}  // namespace edgescout
