#include "host/io/mesh_repair.h"

namespace edgescout {

namespace {

// Fraction of the diameter. Numbers of six digits and single precision leave equal vertices up to
// 5e-6 apart. The finest details of CAD files that were looked at are ten times as large as this,
// and a hundredth of a pixel where the object spans 1,000.
constexpr double weld_share = 1e-5;
// The widest gap between faces that are one surface: a quarter of the step between drawn points.
// Seams that faces divide in their own way, in chords of 15 degrees, stay below it.
constexpr double join_share = 3e-3;

}  // namespace

void repair_mesh(RawMesh& mesh, double size_m) {
  const double weld_m = weld_share * size_m;
  weld_vertices(mesh, weld_m);
  drop_slivers_and_duplicates(mesh, weld_m);
  join_borders(mesh, weld_m, join_share * size_m);
  make_winding_consistent(mesh);
  drop_unused_vertices(mesh);
}

}  // namespace edgescout
