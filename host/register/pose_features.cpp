#include "host/register/pose_features.h"

#include <cmath>

#include "host/register/d2co.h"
#include "host/register/depth_evidence.h"
#include "host/register/edge_support.h"
#include "host/register/pose_classifier.h"
#include "host/register/shading.h"
#include "host/register/visible_in_views.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

// A raster point stands for raster_step_m of edge. The length in the image depends on the angle at
// which the edge is seen: end-on edges are short.
double length_in_image_px(const EdgeModel& model, const Se3& camera_from_object,
                          const BackendView& tensor, std::span<const ModelPoint> points) {
  const Pose pose = to_pose(camera_from_object);
  double length = 0;
  for (const ModelPoint& point : points) {
    const PosedPoint<float> posed = pose_point<float>(pose, point);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<float> edge = project_edge(posed, tensor.intrinsics);
    if (!on_image(edge, tensor.shape.width, tensor.shape.height)) continue;
    length += std::hypot(edge.dx, edge.dy) / (posed.point.z * posed.point.z);
  }
  return length * model.raster_step_m;
}

void add_score(PoseFeatures& f, const PoseScore& score, double cap_px) {
  f.psi = score.psi;
  f.mean_px = score.points > 0 ? score.mean_px : cap_px;
  f.matched = score.matched;
  f.points = score.points;
  f.in_image = f.visible > 0 ? f.points / f.visible : 0;
}

// Of all poses and views in order, as the kernel takes them.
std::vector<PoseProblem> problems_of(const Scene& scene, std::span<const ObjectPose> poses,
                                     const Grid<PointRange>& ranges) {
  std::vector<PoseProblem> problems;
  for (std::size_t p = 0; p < poses.size(); ++p)
    for (std::size_t v = 0; v < scene.views.size(); ++v)
      problems.push_back({to_pose(scene.views[v].camera_from_world * poses[p].world_from_object),
                          ranges(p, v).first, ranges(p, v).count, std::uint32_t(v)});
  return problems;
}

void add_sizes(Grid<PoseFeatures>& features, const Scene& scene, std::span<const ObjectPose> poses,
               const Grid<VisibleInView>& visible) {
  const std::size_t views = scene.views.size();
  for_each_in_chunks(scene.backend.threads(), features.values().size(), 16, [&](std::size_t i) {
    const ObjectPose& pose = poses[i / views];
    const ObjectView& view = scene.views[i % views];
    const VisibleInView& seen = visible.values()[i];
    features.values()[i].visible = double(seen.unoccluded);
    features.values()[i].length_px = length_in_image_px(
        scene.models[std::size_t(pose.object)], view.camera_from_world * pose.world_from_object,
        *view.tensor, seen.points);
  });
}

}  // namespace

Grid<PoseFeatures> features_by_view(const Scene& scene, std::span<const ObjectPose> poses,
                                    const FeatureOptions& options) {
  Grid<PoseFeatures> features(poses.size(), scene.views.size());
  const Grid<VisibleInView> visible = marked_in_views(scene, poses, options.visibility);
  add_sizes(features, scene, poses, visible);
  const PointsInViews<ModelPoint> edges =
      points_of(visible, &VisibleInView::points, 0, scene.backend.threads());
  std::vector<ViewHandle> tensors;
  for (const ObjectView& view : scene.views) tensors.push_back(view.tensor);
  std::vector<PoseScore> scores(features.values().size());
  scene.backend.pose_score(tensors, edges.points, problems_of(scene, poses, edges.ranges),
                           options.score, scores);
  const Grid<Shading> shadings = shading(scene, poses);
  const Grid<EdgeSupport> supports = edge_support(scene, poses, visible);
  Grid<DepthEvidence> depths(poses.size(), scene.views.size());
  if (scene.has_depth()) depths = depth_evidence(scene, poses, visible);
  const std::span<PoseFeatures> cells = features.values();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    add_score(cells[i], scores[i], options.score.cap_px);
    cells[i].shading = shadings.values()[i];
    cells[i].support = supports.values()[i];
    cells[i].depth = depths.values()[i];
  }
  return features;
}

void measure_features(const Scene& scene, std::span<PoseEstimate> poses,
                      const FeatureOptions& options) {
  const Grid<PoseFeatures> features = features_by_view(scene, object_poses(poses), options);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    poses[p].features.assign(features.row(p).begin(), features.row(p).end());
    classify(poses[p]);
  }
}

std::vector<PoseFeatures> pooled_features(const Scene& scene, std::span<const ObjectPose> poses,
                                          const FeatureOptions& options) {
  const Grid<PoseFeatures> by_view = features_by_view(scene, poses, options);
  std::vector<PoseFeatures> features;
  for (std::size_t p = 0; p < poses.size(); ++p)
    features.push_back(pool_over_views(by_view.row(p)));
  return features;
}

}  // namespace edgescout
