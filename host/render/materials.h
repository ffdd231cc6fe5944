// Draws what the surfaces of a scene are made of.
#pragma once

#include "host/core/random.h"
#include "host/render/scene.h"

namespace edgescout {

// Materials of a workshop: bare metal, dark plastic, light plastic, all with a simple highlight.
Material random_material(Random& random);

// Replaces what the ranges tell: some materials become metal or gloss, the others another albedo.
Material with_ranges(Material material, const SurfaceRanges& ranges, const Random& random);

// The board's material. Gloss only, its albedo is the print.
Material board_material(Material paper, const SurfaceRanges& ranges, const Random& random);

}  // namespace edgescout
