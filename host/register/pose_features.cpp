#include "host/register/pose_features.h"

#include <cmath>

#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

struct Slot {
  std::size_t pose;
  double visible;
  double length_px;
};

// A raster point stands for raster_step of edge, seen at an angle; end-on edges are short in the image.
double projected_length_px(const EdgeModel& model, const Se3& camera_from_object, const Intrinsics& k, std::span<const ModelPoint> points) {
  const Pose pose = to_pose(camera_from_object);
  double length = 0;
  for (const ModelPoint& point : points) {
    const PosedPoint<float> posed = pose_point<float>(pose, point);
    const ProjectedEdge<float> edge = project_edge(posed, k);
    length += std::hypot(edge.dx, edge.dy) / (posed.point.z * posed.point.z);
  }
  return length * model.raster_step_m;
}

void add(PoseFeatures& sum, const PoseScore& score) {
  sum.psi += double(score.psi) * score.points;
  sum.mean_px += double(score.mean_px) * score.points;
  sum.matched += double(score.matched) * score.points;
  sum.points += score.points;
}

}  // namespace

double evidence(const PoseFeatures& features) {
  constexpr double spread = 0.308;        // of |cos| of unrelated directions
  constexpr double independent_px = 5;    // neighbouring edge points agree or not together
  return (features.psi - CHANCE_PSI) / spread * std::sqrt(features.length_px / independent_px);
}

std::vector<PoseFeatures> pose_features(std::span<const EdgeModel> models, std::span<const Hypothesis> poses,
                                        std::span<const RegisterView> views, Backend& backend, const PoseScoreOptions& options,
                                        const VisibilityOptions& visibility) {
  std::vector<ModelPoint> points;
  std::vector<PoseProblem> problems;
  std::vector<Slot> slots;
  for (int object = 0; object < int(models.size()); ++object) {
    std::vector<Se3> in_camera;
    const std::size_t first = slots.size();
    for (std::size_t p = 0; p < poses.size(); ++p)
      for (std::size_t v = 0; poses[p].object == object && v < views.size(); ++v) {
        in_camera.push_back(views[v].camera_from_world * poses[p].world_from_object);
        problems.push_back({to_pose(in_camera.back()), 0, 0, static_cast<std::uint32_t>(v)});
        slots.push_back({p, 0, 0});
      }
    const std::vector<std::vector<ModelPoint>> visible = visible_edges(models[object], in_camera, backend, visibility);
    for (std::size_t i = 0; i < visible.size(); ++i) {
      problems[first + i].first_point = static_cast<std::uint32_t>(points.size());
      problems[first + i].point_count = static_cast<std::uint32_t>(visible[i].size());
      slots[first + i].visible = double(visible[i].size());
      slots[first + i].length_px =
          projected_length_px(models[object], in_camera[i], views[problems[first + i].view].view->intrinsics, visible[i]);
      points.insert(points.end(), visible[i].begin(), visible[i].end());
    }
  }
  std::vector<ViewHandle> handles;
  for (const RegisterView& view : views) handles.push_back(view.view);
  std::vector<PoseScore> scores(problems.size());
  backend.pose_score(handles, points, problems, options, scores);
  std::vector<PoseFeatures> features(poses.size());
  std::vector<double> visible(poses.size(), 0);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    add(features[slots[i].pose], scores[i]);
    visible[slots[i].pose] += slots[i].visible;
    features[slots[i].pose].length_px += slots[i].length_px;
  }
  for (std::size_t p = 0; p < poses.size(); ++p) {
    PoseFeatures& f = features[p];
    if (f.points > 0) f.psi /= f.points, f.mean_px /= f.points, f.matched /= f.points;
    if (visible[p] > 0) f.in_image = f.points / visible[p];
    if (f.points == 0) f.mean_px = options.cap_px;
  }
  return features;
}

}  // namespace edgescout
