#include "host/detect/support_views.h"

#include <algorithm>
#include <numeric>

namespace edgescout {

namespace {

double distance_between_cameras_m(const ObjectView& a, const ObjectView& b) {
  return (inverse(a.camera_from_world).translation_m - inverse(b.camera_from_world).translation_m)
      .norm();
}

}  // namespace

std::vector<ObjectView> support_views(const ObjectView& own, std::span<const ObjectView> others,
                                      std::size_t most) {
  if (others.size() <= most) return {others.begin(), others.end()};
  std::vector<std::size_t> nearest_first(others.size());
  std::iota(nearest_first.begin(), nearest_first.end(), std::size_t(0));
  std::ranges::stable_sort(
      nearest_first, {}, [&](std::size_t i) { return distance_between_cameras_m(own, others[i]); });
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < most; ++k)
    chosen.push_back(nearest_first[(2 * k + 1) * others.size() / (2 * most)]);
  std::ranges::sort(chosen);
  std::vector<ObjectView> support;
  for (const std::size_t i : chosen) support.push_back(others[i]);
  return support;
}

std::vector<ObjectView> all_but(std::span<const ObjectView> images, std::size_t own) {
  std::vector<ObjectView> others(images.begin(), images.end());
  others.erase(others.begin() + std::ptrdiff_t(own));
  return others;
}

}  // namespace edgescout
