#include "host/detect/template_support.h"

#include "host/register/depth_evidence.h"
#include "host/register/edge_support.h"
#include "host/register/pose_classifier.h"
#include "host/register/template_points.h"
#include "kernels/template_score.h"
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

// What a point outside the image counts. In one image as much as in the scan. Among several as much
// as in an image without edges, since poses must not gain by leaving such an image.
double outside_px(const Scene& scene, const ObjectView& view) {
  return scene.views.size() > 1 ? view.tensor->options.cap_px : TEMPLATE_SCORE_CAP / 4.0;
}

// The mean residual with the points outside the images, which registration leaves out unless they
// are more than half (points_in_image.h).
double mean_px_with_outside(const PoseEstimate& pose, const TemplatePoints& points, std::size_t p,
                            const Scene& scene) {
  double all = 0, outside = 0, sum_px = 0;
  for (std::size_t v = 0; v < scene.views.size(); ++v) {
    const auto count = double(points.outside(p, v));
    all += points.visible.edges.ranges(p, v).count;
    outside += count;
    sum_px += count * outside_px(scene, scene.views[v]);
  }
  return all > 0 && 2 * outside <= all ? ((all - outside) * pose.mean_px + sum_px) / all
                                       : pose.mean_px;
}

}  // namespace

std::vector<PoseFeatures> template_support(const TemplateSet& set, const Scene& scene,
                                           const std::vector<PoseEstimate>& poses) {
  constexpr int most_edges = 200;
  const std::vector<ObjectPose> placed = object_poses(poses);
  TemplatePoints points =
      template_points(set, scene.views, placed, {.edges = most_edges}, scene.backend);
  const PointsInViews<ModelPoint>& edges = points.visible.edges;
  const Grid<EdgeSupport> support = edge_support(scene, placed, shown_edges(edges));
  Grid<DepthEvidence> depth(poses.size(), scene.views.size());
  if (scene.has_depth()) depth = depth_evidence(scene, placed, std::move(points.visible.surface));
  std::vector<PoseFeatures> pooled(poses.size());
  for_each_in_chunks(scene.backend.threads(), poses.size(), 64, [&](std::size_t p) {
    std::vector<PoseFeatures> by_view(scene.views.size());
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
      by_view[v].support = support(p, v);
      by_view[v].depth = depth(p, v);
      by_view[v].points = by_view[v].visible = double(edges.ranges(p, v).count);
    }
    pooled[p] = pool_over_views(by_view);
    pooled[p].mean_px = mean_px_with_outside(poses[p], points, p, scene);
  });
  return pooled;
}

}  // namespace edgescout
