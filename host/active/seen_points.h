// Internal to host/active: which points of an object's template a camera has seen, or would see.
#pragma once

#include <span>
#include <vector>

#include "host/active/template_table.h"
#include "host/register/object_view.h"
#include "kernels/combination_chamfer.h"

namespace edgescout {

bool is_in_image(double x_px, double y_px, const Camera& camera);

// Template points of one pose that were seen.
struct SeenPoints {
  std::vector<char> by_id;  // of size TemplateTable::total
  std::uint32_t count = 0;
};

// Points that were seen in the real views: they project into the image, and an edge of the image
// lies along the projection within `edge_px`. Where `edge_px` is 0 or the view has no edge index,
// projecting into the image is enough.
SeenPoints points_seen_in(std::span<const ObjectView> real_views, const TemplateTable& table,
                          const Se3& world_from_object, double edge_px);

// Points that would project into the image of `camera`; those that are not in `seen` are marked
// unseen. At most CHAMFER_MAX_POINTS.
std::vector<ParticlePoint> points_in_image(const TemplateTable& table,
                                           const Se3& camera_from_object, const Camera& camera,
                                           const SeenPoints& seen);

}  // namespace edgescout
