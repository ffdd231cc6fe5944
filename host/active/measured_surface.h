// Internal to host/active: the surfaces that depth images measured, as other cameras see them.
#pragma once

#include <span>
#include <vector>

#include "host/register/occluders.h"

namespace edgescout {

// Whether there is a depth image with at least one value.
bool has_measured_depth(const ObjectView& view);

// What hides things from each camera: triangles between neighbouring measurements of the views that
// have depth. Every eighth pixel is one, the median of those around it. Where the surface would be
// steeper than 72 degrees to its camera, or too little was measured, there is none. Empty where no
// view has measured depth. `camera` is that of the maps.
std::vector<Occluders> measured_surfaces(std::span<const ObjectView> views, const Camera& camera,
                                         std::span<const Se3> camera_from_world, Backend& backend);

}  // namespace edgescout
