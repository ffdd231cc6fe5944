// Internal to host/io: mends triangles as CAD exports, scans and converters leave them. make_mesh
// calls repair_mesh; the steps have their own files.
#pragma once

#include "host/io/raw_mesh.h"

namespace edgescout {

// Welds, drops slivers and duplicates, joins borders, and makes the winding consistent. Leaves a
// mesh without such defects as it is. `size_m` is the diameter, above 0. May leave no triangle.
void repair_mesh(RawMesh& mesh, double size_m);

// The smallest height of a triangle: twice the area over the longest side.
double smallest_height(const RawMesh& mesh, const std::array<int, 3>& triangle);

// Keeps the vertices that a triangle uses, in the order of their first use: a stray point would
// make the box and the diameter wrong.
void drop_unused_vertices(RawMesh& mesh);

// Makes vertices at most `tolerance_m` apart one, the first of them. A needle, whose short side is
// no longer than that, becomes one edge: no hole is left.
void weld_vertices(RawMesh& mesh, double tolerance_m);

// Drops triangles at most `tolerance_m` high and all but the first of those with equal corners. The
// long side of a dropped triangle becomes a T-junction, which join_borders mends.
void drop_slivers_and_duplicates(RawMesh& mesh, double tolerance_m);

// Closes gaps between open borders that face each other: loose triangles, T-junctions, and seams
// that both sides divide in their own way. Border vertices are merged or become corners of the
// triangle beside them. The first round closes gaps of `finest_m`, the last one up to `coarsest_m`:
// a border joins the nearest one.
void join_borders(RawMesh& mesh, double finest_m, double coarsest_m);

// Turns triangles over until neighbours agree on the outer side, wherever an edge has two
// triangles. A connected part without a border then encloses a positive volume; one that was
// consistent stays turned inwards if all parts together enclose a positive volume, as the wall of a
// cavity does. A part with a border keeps the winding of its larger area. No winding is right for a
// Moebius strip: some edges stay inconsistent.
void make_winding_consistent(RawMesh& mesh);

}  // namespace edgescout
