#include "host/detect/searched_sizes.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/option_names.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::string advice() {
  return fmt::format(
      "another unit of the model ({}), other distances ({}, {}; metres), or camera poses with "
      "lengths in their right unit",
      option_name("unit"), option_name("distance-min"), option_name("distance-max"));
}

std::string text_of(const SearchedSizes& sizes, double diameter_m, const TemplateOptions& options) {
  return fmt::format(
      "a diameter of {:.1f} mm, which spans {:.1f} to {:.1f} px at {:.3f} to {:.3f} m",
      1000 * diameter_m, sizes.smallest_px, sizes.largest_px, options.distance_min_m,
      options.distance_max_m);
}

}  // namespace

SearchedSizes searched_sizes(double diameter_m, const TemplateOptions& options,
                             const Camera& camera) {
  return {size_px(diameter_m, options.distance_max_m, camera),
          size_px(diameter_m, options.distance_min_m, camera)};
}

void require_searchable_size(const std::string& name, double diameter_m,
                             const TemplateOptions& options, const Camera& camera) {
  const SearchedSizes sizes = searched_sizes(diameter_m, options, camera);
  if (sizes.largest_px < LEAST_SIZE_PX || options.distance_max_m < 0.5 * diameter_m)
    throw InputError(name, "size", text_of(sizes, diameter_m, options), advice());
}

std::string size_warning(const std::string& name, double diameter_m, const TemplateOptions& options,
                         const Camera& camera) {
  const SearchedSizes sizes = searched_sizes(diameter_m, options, camera);
  const double least_px = std::min(camera.width, camera.height) / 20.0,
               most_px = std::max(camera.width, camera.height);
  if (sizes.largest_px >= least_px && sizes.smallest_px <= most_px &&
      sizes.smallest_px >= std::min(LEAST_SIZE_PX, least_px))
    return "";
  return fmt::format("{}: size: found {}, expected {:.0f} to {:.0f} px: {}", name,
                     text_of(sizes, diameter_m, options), least_px, most_px, advice());
}

}  // namespace edgescout
