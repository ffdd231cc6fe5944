#include "host/register/pose_features.h"

#include <algorithm>
#include <cmath>

#include "host/register/occluders.h"
#include "host/register/odds_weights.h"
#include "kernels/error.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

// A raster point stands for raster_step of edge, seen at an angle; end-on edges are short in the image.
double projected_length_px(const EdgeModel& model, const Se3& camera_from_object, const Intrinsics& k,
                           std::span<const ModelPoint> points) {
  const Pose pose = to_pose(camera_from_object);
  double length = 0;
  for (const ModelPoint& point : points) {
    const PosedPoint<float> posed = pose_point<float>(pose, point);
    const ProjectedEdge<float> edge = project_edge(posed, k);
    length += std::hypot(edge.dx, edge.dy) / (posed.point.z * posed.point.z);
  }
  return length * model.raster_step_m;
}

}  // namespace

double evidence(const PoseFeatures& features) {
  constexpr double spread = 0.308;      // of |cos| of unrelated directions
  constexpr double independent_px = 5;  // neighbouring edge points agree or not together
  return (features.psi - CHANCE_PSI) / spread * std::sqrt(features.length_px / independent_px);
}

double weighted_odds(const PoseFeatures& features, const OddsWeights& w) {
  constexpr double least_evidence = 0.5;  // below that all poses are as bad
  return w.bias + w.by_log_evidence * std::log(std::max(evidence(features), least_evidence)) +
         w.by_mean_px * features.mean_px + w.by_unexplained_grey * unexplained_grey(features.shading);
}

double log_odds(const PoseFeatures& features) {
  return weighted_odds(features, {-5.036, 4.105, -0.382, -6.012});
}

std::vector<PoseFeatures> pose_features_by_view(std::span<const EdgeModel> models,
                                                std::span<const Hypothesis> poses,
                                                std::span<const RegisterView> views, Backend& backend,
                                                const PoseScoreOptions& options,
                                                const VisibilityOptions& visibility) {
  std::vector<PoseFeatures> features(poses.size() * views.size());
  std::vector<ModelPoint> points;
  std::vector<PoseProblem> problems;
  std::vector<std::size_t> slots;  // of the problems, in `features`
  for (int object = 0; object < int(models.size()); ++object) {
    std::vector<Se3> in_camera;
    const std::size_t first = slots.size();
    for (std::size_t p = 0; p < poses.size(); ++p)
      for (std::size_t v = 0; poses[p].object == object && v < views.size(); ++v) {
        in_camera.push_back(views[v].camera_from_world * poses[p].world_from_object);
        problems.push_back({to_pose(in_camera.back()), 0, 0, static_cast<std::uint32_t>(v)});
        slots.push_back(p * views.size() + v);
      }
    std::vector<std::vector<ModelPoint>> visible =
        visible_edges(models[object], in_camera, backend, visibility);
    for (std::size_t i = 0; i < visible.size(); ++i)
      features[slots[first + i]].visible = double(visible[i].size());
    remove_hidden(models[object], in_camera, views, visible);
    for (std::size_t i = 0; i < visible.size(); ++i) {
      problems[first + i].first_point = static_cast<std::uint32_t>(points.size());
      problems[first + i].point_count = static_cast<std::uint32_t>(visible[i].size());
      PoseFeatures& f = features[slots[first + i]];
      f.length_px = projected_length_px(models[object], in_camera[i],
                                        views[problems[first + i].view].view->intrinsics, visible[i]);
      points.insert(points.end(), visible[i].begin(), visible[i].end());
    }
  }
  std::vector<ViewHandle> handles;
  for (const RegisterView& view : views) handles.push_back(view.view);
  std::vector<PoseScore> scores(problems.size());
  backend.pose_score(handles, points, problems, options, scores);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    PoseFeatures& f = features[slots[i]];
    f.psi = scores[i].psi;
    f.mean_px = scores[i].points > 0 ? scores[i].mean_px : options.cap_px;
    f.matched = scores[i].matched;
    f.points = scores[i].points;
    f.in_image = f.visible > 0 ? f.points / f.visible : 0;
  }
  const std::vector<Shading> shadings = shading(models, poses, views, backend);
  for (std::size_t i = 0; i < features.size(); ++i) features[i].shading = shadings[i];
  return features;
}

PoseFeatures together(std::span<const PoseFeatures> by_view) {
  check(!by_view.empty(), "together: features of at least one view");
  PoseFeatures sum;
  for (const PoseFeatures& f : by_view) {
    sum.psi += f.psi * f.points;
    sum.mean_px += f.mean_px * f.points;
    sum.matched += f.matched * f.points;
    sum.points += f.points;
    sum.length_px += f.length_px;
    sum.visible += f.visible;
    add(sum.shading, f.shading);
  }
  if (sum.points > 0)
    sum.psi /= sum.points, sum.mean_px /= sum.points, sum.matched /= sum.points;
  else
    sum.mean_px = by_view[0].mean_px;
  if (sum.visible > 0) sum.in_image = sum.points / sum.visible;
  return sum;
}

std::vector<PoseFeatures> pose_features(std::span<const EdgeModel> models, std::span<const Hypothesis> poses,
                                        std::span<const RegisterView> views, Backend& backend,
                                        const PoseScoreOptions& options,
                                        const VisibilityOptions& visibility) {
  const std::vector<PoseFeatures> by_view =
      pose_features_by_view(models, poses, views, backend, options, visibility);
  std::vector<PoseFeatures> features;
  for (std::size_t p = 0; p < poses.size(); ++p)
    features.push_back(together(std::span(by_view).subspan(p * views.size(), views.size())));
  return features;
}

}  // namespace edgescout
