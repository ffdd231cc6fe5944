#include "host/detect/support_views.h"

#include <algorithm>
#include <numeric>

namespace edgescout {

namespace {

double between_cameras_m(const Observation& a, const Observation& b) {
  return (inverse(a.view.camera_from_world).translation_m -
          inverse(b.view.camera_from_world).translation_m)
      .norm();
}

}  // namespace

std::vector<Observation> support_views(const Observation& own, std::span<const Observation> others,
                                       std::size_t most) {
  if (others.size() <= most) return {others.begin(), others.end()};
  std::vector<std::size_t> nearest_first(others.size());
  std::iota(nearest_first.begin(), nearest_first.end(), std::size_t(0));
  std::ranges::stable_sort(nearest_first, {},
                           [&](std::size_t i) { return between_cameras_m(own, others[i]); });
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < most; ++k)
    chosen.push_back(nearest_first[(2 * k + 1) * others.size() / (2 * most)]);
  std::ranges::sort(chosen);
  std::vector<Observation> helping;
  for (const std::size_t i : chosen) helping.push_back(others[i]);
  return helping;
}

std::vector<Observation> all_but(std::span<const Observation> images, std::size_t own) {
  std::vector<Observation> others(images.begin(), images.end());
  others.erase(others.begin() + std::ptrdiff_t(own));
  return others;
}

}  // namespace edgescout
