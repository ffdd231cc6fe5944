// Random edge points in an image.
#pragma once

#include <numbers>
#include <vector>

#include "host/core/random.h"
#include "kernels/types.h"

namespace edgescout::test {

inline std::vector<EdgePoint> random_edges(int count, int width, int height, Random& random) {
  std::vector<EdgePoint> edges;
  for (int i = 0; i < count; ++i)
    edges.push_back({float(random.uniform(0, width - 1)), float(random.uniform(0, height - 1)),
                     float(random.uniform(0, std::numbers::pi)), 1});
  return edges;
}

}  // namespace edgescout::test
