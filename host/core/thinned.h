// A smaller sample of a list.
#pragma once

#include <cstddef>
#include <vector>

namespace edgescout {

// `most` of the values, evenly; all of them where `most` is 0 or enough.
template <typename T>
std::vector<T> thinned(const std::vector<T>& values, int most) {
  if (most <= 0 || int(values.size()) <= most) return values;
  std::vector<T> kept(most);
  for (int i = 0; i < most; ++i) kept[i] = values[std::size_t(i) * values.size() / most];
  return kept;
}

}  // namespace edgescout
