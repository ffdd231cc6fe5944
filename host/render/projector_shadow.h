// What the projector of a structured-light sensor sees.
#pragma once

#include <vector>

#include "host/render/seen_surface.h"

namespace edgescout {

// Per surface, whether a projector sees it that stands beside the camera, `baseline_m` along +x.
// Surfaces at the horizon count as seen.
std::vector<char> lit_by_projector(const ViewRaster& view, const SceneView& scene_view,
                                   const std::vector<SeenSurface>& surfaces, double baseline_m,
                                   ThreadPool& pool);

}  // namespace edgescout
