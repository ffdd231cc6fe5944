#include "host/active/seen_points.h"

#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

constexpr float MAX_TURN_RAD = 0.35f;  // between the template's edge and that of the image

}  // namespace

bool is_in_image(double x_px, double y_px, const Camera& camera) {
  return x_px >= -0.5 && y_px >= -0.5 && x_px < camera.width - 0.5 && y_px < camera.height - 0.5;
}

SeenPoints points_seen_in(std::span<const ObjectView> real_views, const TemplateTable& table,
                          const Se3& world_from_object, double edge_px) {
  SeenPoints seen{std::vector<char>(table.total, 0), 0};
  const EdgeReach near(float(edge_px), MAX_TURN_RAD);
  for (const ObjectView& view : real_views) {
    const Se3 camera_from_object = view.camera_from_world * world_from_object;
    const Pose pose = to_pose(camera_from_object);
    const Intrinsics k = intrinsics_of(view.camera);
    for (const TemplateTablePoint& p : table.visible_from(camera_from_object)) {
      const PosedPoint<float> posed = pose_point<float>(pose, p.point);
      if (seen.by_id[p.id] || !can_be_seen(posed.point)) continue;
      const ProjectedEdge<float> edge = project_edge(posed, k);
      if (!is_in_image(edge.u, edge.v, view.camera)) continue;
      if (edge_px > 0 && view.edges &&
          !view.edges->nearest({edge.u, edge.v}, {edge.dx, edge.dy}, near))
        continue;
      seen.by_id[p.id] = 1;
      ++seen.count;
    }
  }
  return seen;
}

std::vector<ParticlePoint> points_in_image(const TemplateTable& table,
                                           const Se3& camera_from_object, const Camera& camera,
                                           const SeenPoints& seen) {
  std::vector<ParticlePoint> points;
  const Pose pose = to_pose(camera_from_object);
  const Intrinsics k = intrinsics_of(camera);
  for (const TemplateTablePoint& p : table.visible_from(camera_from_object)) {
    const PosedPoint<float> posed = pose_point<float>(pose, p.point);
    if (!can_be_seen(posed.point) || points.size() == CHAMFER_MAX_POINTS) continue;
    const ProjectedEdge<float> edge = project_edge(posed, k);
    if (is_in_image(edge.u, edge.v, camera))
      points.push_back({edge.u, edge.v, posed.point.z, seen.by_id[p.id] ? 0u : 1u});
  }
  return points;
}

}  // namespace edgescout
