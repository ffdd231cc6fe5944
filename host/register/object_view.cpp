#include "host/register/object_view.h"

#include <algorithm>
#include <cmath>

#include "kernels/error.h"

namespace edgescout {

std::size_t level_for(double size_px, const ObjectView& view) {
  std::size_t best = 0;
  double least = INFINITY;
  for (std::size_t level = 0; level < view.reduced.size(); ++level) {
    const double misfit =
        std::abs(std::log(size_px / (REDUCED_SIZE_PX * view.reduced[level].reduction)));
    if (misfit < least) least = misfit, best = level;
  }
  return best;
}

std::vector<ObjectView> on_coarse_tensors(std::span<const ObjectView> views, std::size_t level) {
  std::vector<ObjectView> coarse(views.begin(), views.end());
  for (ObjectView& view : coarse) {
    if (view.reduced.empty()) continue;
    check(level < view.reduced.size(), "on_coarse_tensors: no such level");
    view.tensor = view.reduced[level].coarse;
  }
  return coarse;
}

}  // namespace edgescout
