#include "host/register/pose_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/core/thinned.h"
#include "host/register/d2co.h"
#include "host/register/edge_support.h"
#include "host/register/pose_classifier.h"
#include "host/register/shading.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"
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

constexpr int BACKGROUND_COPIES = 8;  // directions in which a pose is moved aside
// Of the diameter: further than edges are wide, in the same surroundings.
constexpr double BACKGROUND_SHIFT = 0.05;
constexpr int BACKGROUND_POINTS = 150;  // enough for a mean

// Poses with their points, as the kernel takes them.
struct Problems {
  std::vector<ModelPoint> points;
  std::vector<PoseProblem> list;

  void add(const Se3& camera_from_object, std::size_t view,
           const std::vector<ModelPoint>& visible) {
    add_one(camera_from_object, view, visible.size());
    points.insert(points.end(), visible.begin(), visible.end());
  }

  // Copies of the pose moved along the image plane.
  void add_background(const Se3& camera_from_object, double diameter_m, std::size_t view,
                      const std::vector<ModelPoint>& visible) {
    const std::vector<ModelPoint> kept = thinned(visible, BACKGROUND_POINTS);
    for (int i = 0; i < BACKGROUND_COPIES; ++i) {
      const double angle = 2 * std::numbers::pi * i / BACKGROUND_COPIES;
      Se3 moved = camera_from_object;
      moved.translation_m +=
          BACKGROUND_SHIFT * diameter_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      add_one(moved, view, kept.size());
    }
    points.insert(points.end(), kept.begin(), kept.end());
  }

 private:
  void add_one(const Se3& camera_from_object, std::size_t view, std::size_t count) {
    list.push_back({to_pose(camera_from_object), std::uint32_t(points.size()), std::uint32_t(count),
                    std::uint32_t(view)});
  }
};

double mean_psi(std::span<const PoseScore> scores) {
  double sum = 0, points = 0;
  for (const PoseScore& score : scores) sum += score.psi * score.points, points += score.points;
  return points > 0 ? sum / points : 0;
}

// `scores`: of the pose, then of its background copies.
void add_scores(PoseFeatures& f, std::span<const PoseScore> scores, double cap_px) {
  const PoseScore& of_pose = scores[0];
  f.psi = of_pose.psi;
  f.background_psi = mean_psi(scores.subspan(1));
  f.mean_px = of_pose.points > 0 ? of_pose.mean_px : cap_px;
  f.matched = of_pose.matched;
  f.points = of_pose.points;
  f.in_image = f.visible > 0 ? f.points / f.visible : 0;
}

// Appends the problems of all poses and views in order. Fills what is known of the visible points.
Problems make_problems(const Scene& scene, std::span<const ObjectPose> poses,
                       const Grid<VisibleInView>& visible, bool with_background,
                       Grid<PoseFeatures>& features) {
  Problems problems;
  for (std::size_t p = 0; p < poses.size(); ++p)
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
      const EdgeModel& model = scene.models[std::size_t(poses[p].object)];
      const ObjectView& view = scene.views[v];
      const std::vector<ModelPoint>& points = visible(p, v).points;
      const Se3 camera_from_object = view.camera_from_world * poses[p].world_from_object;
      features(p, v).visible = double(visible(p, v).unoccluded);
      features(p, v).length_px =
          length_in_image_px(model, camera_from_object, *view.tensor, points);
      problems.add(camera_from_object, v, points);
      if (with_background)
        problems.add_background(camera_from_object, model.mesh.diameter_m, v, points);
    }
  return problems;
}

Grid<PoseFeatures> measure(const Scene& scene, std::span<const ObjectPose> poses,
                           const FeatureOptions& options, bool with_background) {
  Grid<PoseFeatures> features(poses.size(), scene.views.size());
  const Grid<VisibleInView> visible = marked_in_views(scene, poses, options.visibility);
  const Problems problems = make_problems(scene, poses, visible, with_background, features);
  std::vector<ViewHandle> tensors;
  for (const ObjectView& view : scene.views) tensors.push_back(view.tensor);
  std::vector<PoseScore> scores(problems.list.size());
  scene.backend.pose_score(tensors, problems.points, problems.list, options.score, scores);
  const std::size_t copies = with_background ? 1 + BACKGROUND_COPIES : 1;
  const std::span<PoseFeatures> cells = features.values();
  for (std::size_t i = 0; i < cells.size(); ++i)
    add_scores(cells[i], std::span(scores).subspan(i * copies, copies), options.score.cap_px);
  const Grid<Shading> shadings = shading(scene, poses);
  const Grid<EdgeSupport> supports = edge_support(scene, poses, visible);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].shading = shadings.values()[i];
    cells[i].support = supports.values()[i];
  }
  return features;
}

}  // namespace

Grid<PoseFeatures> features_by_view(const Scene& scene, std::span<const ObjectPose> poses,
                                    const FeatureOptions& options) {
  return measure(scene, poses, options, scene.views.size() > 1);
}

void measure_features(const Scene& scene, std::span<PoseEstimate> poses,
                      const FeatureOptions& options) {
  const Grid<PoseFeatures> features = features_by_view(scene, object_poses(poses), options);
  for (std::size_t p = 0; p < poses.size(); ++p)
    poses[p].features.assign(features.row(p).begin(), features.row(p).end());
}

std::vector<PoseFeatures> pooled_features(const Scene& scene, std::span<const ObjectPose> poses,
                                          const FeatureOptions& options) {
  const Grid<PoseFeatures> by_view = measure(scene, poses, options, false);
  std::vector<PoseFeatures> features;
  for (std::size_t p = 0; p < poses.size(); ++p)
    features.push_back(pool_over_views(by_view.row(p)));
  return features;
}

}  // namespace edgescout
