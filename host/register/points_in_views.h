// The points of poses in views as the kernels take them: one list, of which each pair of a pose and
// a view has a part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/core/grid.h"
#include "host/core/thinned.h"
#include "kernels/thread_pool.h"
#include "kernels/unfilled.h"

namespace edgescout {

struct PointRange {
  std::uint32_t first = 0, count = 0;
};

// Rows are poses, columns views. Pairs may share a part.
template <typename T>
struct PointsInViews {
  Unfilled<T> points;
  Grid<PointRange> ranges;
};

// Lists one after the other, and where each lies.
template <typename T>
struct JoinedLists {
  Unfilled<T> values;
  std::vector<PointRange> ranges;
};

// `list_of(i)` is list i of `count`. Of each at most `most` values, evenly thinned; 0: all.
template <typename ListOf>
auto join_lists(std::size_t count, const ListOf& list_of, int most, ThreadPool& threads) {
  using T = typename std::remove_cvref_t<decltype(list_of(0))>::value_type;
  JoinedLists<T> joined;
  joined.ranges.reserve(count);
  std::size_t total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t kept = thinned_size(list_of(i).size(), most);
    joined.ranges.push_back({std::uint32_t(total), std::uint32_t(kept)});
    total += kept;
  }
  joined.values.resize(total);
  for_each_in_chunks(threads, count, 64, [&](std::size_t i) {
    const PointRange& range = joined.ranges[i];
    thin_into<T>(std::span(joined.values).subspan(range.first, range.count), list_of(i));
  });
  return joined;
}

}  // namespace edgescout
