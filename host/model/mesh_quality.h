// How well a mesh serves as a model: what `model inspect` prints, and what every verb warns of.
//
// Public header.
#pragma once

#include <cstddef>
#include <string>

#include "host/model/edge_model.h"

namespace edgescout {

struct MeshQuality {
  double drawn_m = 0;            // length of the drawn edges
  double open_border_share = 0;  // of that length: on open borders
  // Of that length: in edges shorter than the raster step. Pieces that continue each other, as
  // those of a finely divided rim, are one edge.
  double short_edge_share = 0;
  std::size_t inconsistent_edges = 0;  // between two triangles whose windings disagree
};

MeshQuality mesh_quality(const EdgeModel& model);

// Returns one line that names the mesh and what is wrong with it: more than a tenth of the drawn
// length is open border, more than half is in short edges, or a winding is inconsistent. Else
// empty.
std::string mesh_warning(const EdgeModel& model);

// Logs mesh_warning where there is one.
void warn_of_mesh(const EdgeModel& model);

}  // namespace edgescout
