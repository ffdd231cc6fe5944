// Decides which edges of a mesh are drawn: sharp creases and open borders.
#pragma once

#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/io/mesh_edges.h"

namespace edgescout {

struct MeshEdge {
  enum class Kind { Smooth, Crease, OpenBorder };
  std::span<const HalfEdge> sides;  // of `sorted` below
  Kind kind;
};

// Every edge once, in the order of `sorted` (sorted_half_edges). The angle between two faces does
// not depend on their windings. An edge of three or more triangles is smooth where they lie in two
// opposite directions from it, as those of a surface that is there twice. An open border is smooth
// where another face goes on beyond it in the same plane.
std::vector<MeshEdge> mesh_edges(const Mesh& mesh, std::span<const HalfEdge> sorted,
                                 double cos_crease);

}  // namespace edgescout
