// A smaller sample of a list.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace edgescout {

// How many of `size` values `thinned` keeps.
inline std::size_t thinned_size(std::size_t size, int most) {
  return most <= 0 || size <= std::size_t(most) ? size : std::size_t(most);
}

// As many of the values as there is room for, evenly.
template <typename T>
void thin_into(std::span<T> kept, std::span<const T> values) {
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = values[i * values.size() / kept.size()];
}

// `most` of the values, evenly; all of them where `most` is 0 or enough.
template <typename T>
std::vector<T> thinned(const std::vector<T>& values, int most) {
  std::vector<T> kept(thinned_size(values.size(), most));
  thin_into<T>(kept, values);
  return kept;
}

}  // namespace edgescout
