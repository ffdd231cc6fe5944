// How large objects appear in an image at the distances that are searched. A wrong unit of a mesh
// or of camera poses shows here first.
//
// Public header.
#pragma once

#include <string>

#include "host/model/template_set.h"

namespace edgescout {

// Of an object's diameter, in the middle of the image.
struct SearchedSizes {
  double smallest_px, largest_px;  // at the farthest and at the nearest distance
};
SearchedSizes searched_sizes(double diameter_m, const TemplateOptions& options,
                             const Camera& camera);

// An object of at least this size has a shape; below, any edges of the image match it.
inline constexpr double LEAST_SIZE_PX = 8;

// Checks the sizes that are searched. InputError naming the object, its sizes and what may be
// wrong: it spans less than LEAST_SIZE_PX at every searched distance, or the camera would stand
// inside it.
void require_searchable_size(const std::string& name, double diameter_m,
                             const TemplateOptions& options, const Camera& camera);

// Returns a sentence for a warning where the object spans less than a twentieth of the image's
// smaller side, or more than its larger side, at every searched distance, or less than both that
// twentieth and LEAST_SIZE_PX at the farthest. Else empty.
std::string size_warning(const std::string& name, double diameter_m, const TemplateOptions& options,
                         const Camera& camera);

}  // namespace edgescout
