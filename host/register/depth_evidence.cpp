#include "host/register/depth_evidence.h"

#include "host/register/depth_systems.h"
#include "host/register/thresholds.h"

namespace edgescout {

DepthEvidence evidence_of(const PoseDepth& depth) {
  const double mean_m = depth.weight_sum > 0 ? depth.offset_m / double(depth.weight_sum) : 0;
  return {depth.agreeing, depth.contradicting, depth.hidden, depth.missing,
          mean_m * depth.agreeing};
}

Grid<DepthEvidence> depth_evidence(const Scene& scene, std::span<const ObjectPose> poses,
                                   PointsInViews<SurfacePoint> surface) {
  Grid<DepthEvidence> evidence(poses.size(), scene.views.size());
  std::vector<DepthHandle> depths;
  std::vector<PoseProblem> problems;
  std::vector<DepthEvidence*> cells;
  for (std::size_t v = 0; v < scene.views.size(); ++v) {
    const ObjectView& view = scene.views[v];
    if (!view.depth_values) continue;
    for (std::size_t p = 0; p < poses.size(); ++p) {
      const PointRange& range = surface.ranges(p, v);
      problems.push_back({to_pose(view.camera_from_world * poses[p].world_from_object), range.first,
                          range.count, std::uint32_t(depths.size())});
      cells.push_back(&evidence(p, v));
    }
    depths.push_back(view.depth_values);
  }
  if (depths.empty()) return evidence;
  std::vector<PoseDepth> found(problems.size());
  scene.backend.pose_depth(depths, *scene.backend.make_surface_points(std::move(surface.points)),
                           problems, pose_depth_options(scene, JUDGEMENT_BAND), found);
  for (std::size_t i = 0; i < found.size(); ++i) *cells[i] = evidence_of(found[i]);
  return evidence;
}

Grid<DepthEvidence> depth_evidence(const Scene& scene, std::span<const ObjectPose> poses,
                                   const Grid<VisibleInView>& visible) {
  return depth_evidence(scene, poses,
                        points_of(visible, &VisibleInView::surface, 0, scene.backend.threads()));
}

bool is_contradicted(const DepthEvidence& evidence) {
  const double measured = evidence.agreeing + evidence.contradicting;
  return measured >= thresholds::MIN_DEPTH_SAMPLES && evidence.contradicting > 0.5 * measured;
}

}  // namespace edgescout
