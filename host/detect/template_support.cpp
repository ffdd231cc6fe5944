#include "host/detect/template_support.h"

#include "host/detect/template_points.h"
#include "host/register/depth_evidence.h"
#include "host/register/edge_support.h"
#include "host/register/pose_classifier.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

Grid<ShownEdges> shown_edges(const PointsInViews<ModelPoint>& edges) {
  Grid<ShownEdges> shown(edges.ranges.rows(), edges.ranges.columns());
  std::ranges::transform(
      edges.ranges.values(), shown.values().begin(), [&](const PointRange& range) {
        return ShownEdges{std::span(edges.points).subspan(range.first, range.count), {}};
      });
  return shown;
}

}  // namespace

std::vector<PoseFeatures> template_support(const TemplateSet& set, const Scene& scene,
                                           const std::vector<PoseEstimate>& poses) {
  constexpr int most_edges = 200;
  const std::vector<ObjectPose> placed = object_poses(poses);
  VisiblePoints visible =
      template_points(set, scene.views, placed, {.edges = most_edges}, scene.backend);
  const Grid<EdgeSupport> support = edge_support(scene, placed, shown_edges(visible.edges));
  const Grid<DepthEvidence> depth = depth_evidence(scene, placed, std::move(visible.surface));
  std::vector<PoseFeatures> pooled(poses.size());
  for_each_in_chunks(scene.backend.threads(), poses.size(), 64, [&](std::size_t p) {
    std::vector<PoseFeatures> by_view(scene.views.size());
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
      by_view[v].support = support(p, v);
      by_view[v].depth = depth(p, v);
      by_view[v].points = by_view[v].visible = double(visible.edges.ranges(p, v).count);
    }
    pooled[p] = pool_over_views(by_view);
    pooled[p].mean_px = poses[p].mean_px;
  });
  return pooled;
}

}  // namespace edgescout
