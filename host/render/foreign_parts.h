// Adds parts that are not searched for: on the board, among the targets, and in the air.
#pragma once

#include "host/core/random.h"
#include "host/render/scene.h"

namespace edgescout {

// Adds the parts that lie on the board, without their poses: meshes of `files`, scaled, or else
// boxes, bars and rings as many as the clutter level tells. `diameter_m`: mean of the targets'.
void add_foreign_parts(SimulatedScene& scene, std::span<const Mesh> files, double diameter_m,
                       const Random& random);

// Hangs parts between the cameras and targets, with their poses. `scene` has its views.
void add_occluders(SimulatedScene& scene, std::span<const Mesh> files, double diameter_m,
                   const Random& random);

}  // namespace edgescout
