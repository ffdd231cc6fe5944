// Matches estimates with true instances by BOP's greedy method.
#pragma once

#include <span>
#include <vector>

namespace edgescout {

inline constexpr int UNMATCHED = -1;

// Each estimate in turn, best score first, takes the free truth with the smallest error below
// `threshold`. `errors` is [estimate][truth], infinite for a pair that cannot match. Returns the
// truth of every estimate, or UNMATCHED. Without truths `errors` is empty, and so is the result.
std::vector<int> match_in_order(std::span<const double> errors, int truths, double threshold);

}  // namespace edgescout
