// Samples of a mesh's surface, for the comparison of poses with measured depth.
#pragma once

#include <vector>

#include "host/core/types.h"
#include "kernels/pose_depth.h"

namespace edgescout {

// Spread evenly over the surface, in an order whose every beginning is spread evenly too. Normals
// point outwards. A mesh with open borders has no inside: each of its places gives two samples, one
// for each side. Equal meshes give equal samples.
std::vector<SurfacePoint> sample_surface(const Mesh& mesh, bool has_open_borders, int count);

}  // namespace edgescout
