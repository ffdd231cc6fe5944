// Where a depth sensor measures nothing.
#pragma once

#include "host/core/depth_image.h"
#include "host/render/sensed_view.h"

namespace edgescout {

// Removes what is grazing, blinding, out of the projector's sight, in a blob or out of range.
void drop_unmeasured(DepthImage& depth, const SensedView& sensed, ThreadPool& pool);

}  // namespace edgescout
