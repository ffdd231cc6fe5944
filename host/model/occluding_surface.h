// A coarse copy of a dense mesh for depth maps, which decide what hides what.
//
// A depth map costs as much as its mesh has triangles, and detection draws thousands for an image.
#pragma once

#include <cstdint>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// In the format of the kernels: xyz triples and index triples.
struct OccludingSurface {
  std::vector<float> vertices_m;
  std::vector<std::uint32_t> triangles;
};

// Of the diameter: no vertex of the mesh is farther than this from the copy. It is half a pixel
// where the object spans 500, a tenth of the tolerance of visible_edges.
inline constexpr double OCCLUDING_SURFACE_ERROR = 1e-3;
// A mesh of at most this many triangles is its own copy.
inline constexpr std::size_t OCCLUDING_SURFACE_FULL = 4000;

OccludingSurface occluding_surface(const Mesh& mesh);

}  // namespace edgescout
