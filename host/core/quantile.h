// Quantiles of a sample.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace edgescout {

// The value below which about `share` of the others lie, [0, 1]; one of the values. 0 without any.
template <typename Number>
Number quantile(std::vector<Number> values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Of an even number of values the upper one of both in the middle.
template <typename Number>
Number upper_median(std::vector<Number> values) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace edgescout
