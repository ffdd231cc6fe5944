// Puts the cameras of a scene on a hemisphere over the board.
#pragma once

#include "host/core/random.h"
#include "host/render/scene.h"

namespace edgescout {

// `scene` has its targets with their poses. `diameter_m`: the targets' mean diameter.
void add_views(SimulatedScene& scene, double diameter_m, const Random& random);

}  // namespace edgescout
