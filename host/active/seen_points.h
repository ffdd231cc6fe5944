// Internal to host/active: which points of an object's template a camera has, or would have, seen.
#pragma once

#include <span>
#include <vector>

#include "host/active/template_table.h"
#include "host/register/d2co.h"
#include "kernels/combination_chamfer.h"

namespace edgescout {

// Ids of one pose's template points that were seen.
struct SeenPoints {
  std::vector<char> by_id;  // size TemplateTable::total
  std::uint32_t count = 0;
};

// In the real views: points that project into the image and, where `edge_px` is above 0 and the
// view has an edge index, along whose projection an edge of the image lies that near.
SeenPoints seen_in(const TemplateTable& table, const Se3& world_from_object,
                   std::span<const RegisterView> real_views, double edge_px);

// Points that would show inside the image of `camera` from a view, those not in `seen` flagged
// unseen; at most CHAMFER_MAX_POINTS.
std::vector<ParticlePoint> showing_points(const TemplateTable& table, const Se3& camera_from_object,
                                          const Camera& camera, const SeenPoints& seen);

}  // namespace edgescout
