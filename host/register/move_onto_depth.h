// Moves a start onto the measured surface.
#pragma once

#include "host/register/scene.h"

namespace edgescout {

// Along the ray to the object's centre by what the first view with depth measured most often before
// or behind the start's surface. Starts of other methods are least exact along that ray; behind a
// measured surface all their edges would count as hidden. Unchanged where fewer than 20 samples are
// measured, or the surface is within the tolerance of occluders.h.
ObjectPose moved_onto_depth(const Scene& scene, const ObjectPose& start);

}  // namespace edgescout
