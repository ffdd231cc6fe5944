// Which points of an object's edges are visible from where, prepared once: the visible points of
// particles are looked up, not computed.
#pragma once

#include <cstdint>
#include <vector>

#include "host/model/viewpoint_index.h"
#include "host/model/visible_edges.h"

namespace edgescout {

// A point of the object's edges. The same place on the object has the same `id` in every viewpoint.
struct TemplateTablePoint {
  ModelPoint point;
  std::uint32_t id = 0;
};

struct TemplateTable {
  ViewpointIndex viewpoints;
  std::vector<std::vector<TemplateTablePoint>> points;  // visible from each viewpoint
  std::uint32_t total = 0;  // number of ids: places that are visible from any viewpoint

  // Points that are visible from the viewpoint nearest to the camera.
  const std::vector<TemplateTablePoint>& visible_from(const Se3& camera_from_object) const {
    return points[viewpoints.nearest(camera_from_object).viewpoint];
  }
};

struct TemplateTableOptions {
  int frequency =
      4;  // of the icosphere (model/viewpoints.h): viewpoints about 60 / f degrees apart
  // From any one viewpoint. Places are cubic cells, as large as this limit requires.
  int most_points = 500;
};

// Viewpoints are `distance_m` from the object's centre, or farther where the object is larger: the
// visible points hardly depend on the distance. InputError: a mesh that shows no edge from
// anywhere; LogicError: most_points below 1.
TemplateTable make_template_table(const EdgeModel& model, double distance_m, Backend& backend,
                                  const TemplateTableOptions& options = {});

}  // namespace edgescout
