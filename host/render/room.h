// A room around the table, as a source of reflections.
#pragma once

#include "host/core/random.h"
#include "host/render/environment.h"

namespace edgescout {

// Walls with windows, doors and cupboards, and a ceiling with lamps, of random places and sizes.
FarLight random_room(Random random);

}  // namespace edgescout
