// Puts lamps over a scene, and the light that comes from all other directions.
#pragma once

#include "host/core/random.h"
#include "host/render/scene.h"

namespace edgescout {

// Adds two lamps and the sky. If surfaces reflect, the sky is that of an environment: a photograph,
// or a room if there is none. `scene` has its targets with their poses.
void add_lights(SimulatedScene& scene, const PhotographFolders& photographs, const Random& random);

}  // namespace edgescout
