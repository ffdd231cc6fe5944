// The part of a list of points that some problems or jobs name, with what lies between.
#pragma once

#include <algorithm>
#include <cstdint>

namespace edgescout::gpu {

struct PointRange {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t size() const { return end - begin; }
  void include(std::uint32_t first, std::uint32_t count) {
    if (count == 0) return;
    begin = size() == 0 ? first : std::min(begin, first);
    end = std::max(end, first + count);
  }
};

}  // namespace edgescout::gpu
