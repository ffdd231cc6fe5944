// Simplifies a dense mesh within a bound on the distance between both surfaces.
#pragma once

#include <array>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// Triangles of a coarser mesh with some of the vertices of the fine one. No vertex of the fine mesh
// is farther than `error_m` from them. Removes vertices by moving each onto a neighbour, those
// first that change the surface least. Keeps the topology, and vertices where the mesh is not a
// surface: at edges of three triangles, or where windings disagree.
std::vector<std::array<int, 3>> simplify(const Mesh& mesh, double error_m);

}  // namespace edgescout
