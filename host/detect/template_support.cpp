#include "host/detect/template_support.h"

#include "host/detect/template_points.h"
#include "host/register/depth_evidence.h"
#include "host/register/edge_support.h"
#include "host/register/pose_classifier.h"
#include "kernels/thread_pool.h"

namespace edgescout {

std::vector<PoseFeatures> template_support(const TemplateSet& set, const Scene& scene,
                                           const std::vector<PoseEstimate>& poses) {
  constexpr int most_points = 200;
  const std::vector<ObjectPose> placed = object_poses(poses);
  Grid<PointsInView> points = template_points(set, scene.views, most_points, scene.backend)(placed);
  Grid<VisibleInView> visible(poses.size(), scene.views.size());
  for_each_in_chunks(scene.backend.threads(), visible.values().size(), 64, [&](std::size_t i) {
    VisibleInView& cell = visible.values()[i];
    cell.points = std::move(points.values()[i].edges);
    cell.surface = std::move(points.values()[i].surface);
    cell.on_silhouette.assign(cell.points.size(), 0);
  });
  const Grid<EdgeSupport> support = edge_support(scene, placed, visible);
  const Grid<DepthEvidence> depth = depth_evidence(scene, placed, visible);
  std::vector<PoseFeatures> pooled;
  std::vector<PoseFeatures> by_view(scene.views.size());
  for (std::size_t p = 0; p < poses.size(); ++p) {
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
      by_view[v].support = support(p, v);
      by_view[v].depth = depth(p, v);
      by_view[v].points = by_view[v].visible = double(visible(p, v).points.size());
    }
    pooled.push_back(pool_over_views(by_view));
    pooled.back().mean_px = poses[p].mean_px;
  }
  return pooled;
}

}  // namespace edgescout
