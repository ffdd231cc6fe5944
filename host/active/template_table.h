// Which points of an object's edges show from where, prepared once: for particles visible points
// are looked up, not computed.
#pragma once

#include <cstdint>
#include <vector>

#include "host/model/visible_edges.h"

namespace edgescout {

// A point of the object's edges; the same place of the object has the same `id` in every viewpoint.
struct TemplateTablePoint {
  ModelPoint point;
  std::uint32_t id = 0;
};

struct TemplateTable {
  std::vector<Eigen::Vector3d> directions;  // unit, from the object's centre to the camera
  std::vector<std::vector<TemplateTablePoint>> points;  // visible from there
  std::uint32_t total = 0;                              // ids: places that show from anywhere
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();

  // Points visible from the viewpoint nearest to the camera's.
  const std::vector<TemplateTablePoint>& seen_from(const Se3& camera_from_object) const;
};

struct TemplateTableOptions {
  int frequency =
      4;  // of the icosphere (model/viewpoints.h): directions about 60 / f degrees apart
  int most_points =
      500;  // from any one viewpoint; places are cells of space, as large as that takes
};

// `distance_m` from the object's centre: the visible points hardly depend on it. InputError where
// the mesh shows no edge from anywhere.
TemplateTable make_template_table(const EdgeModel& model, double distance_m, Backend& backend,
                                  const TemplateTableOptions& options = {});

}  // namespace edgescout
