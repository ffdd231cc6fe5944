// Which estimate found which true instance: BOP's greedy matching.
#pragma once

#include <span>
#include <vector>

namespace edgescout {

inline constexpr int UNMATCHED = -1;

// Estimates in their order, best score first, each take the free truth with the smallest error
// below `threshold`. `errors` is [estimate][truth], infinite where a pair cannot match. Returns
// every estimate's truth, or UNMATCHED; without truths there are no errors, and nothing is
// returned.
std::vector<int> match_in_order(std::span<const double> errors, int truths, double threshold);

}  // namespace edgescout
