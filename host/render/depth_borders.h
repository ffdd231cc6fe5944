// What a depth sensor makes of the jumps of depth.
#pragma once

#include "host/core/depth_image.h"
#include "host/render/sensed_view.h"

namespace edgescout {

// Around a jump a share of the pixels is missing; the others lie between both surfaces, evenly.
void smear_borders(DepthImage& depth, const SensedView& sensed);

}  // namespace edgescout
