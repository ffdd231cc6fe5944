#include "host/register/pose_features.h"

#include <algorithm>
#include <cmath>

#include "host/register/odds_weights.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

// A raster point stands for raster_step of edge, seen at an angle; end-on edges are short in the image.
double length_in_image_px(const EdgeModel& model, const Se3& camera_from_object, const BackendView& view,
                          std::span<const ModelPoint> points) {
  const Pose pose = to_pose(camera_from_object);
  double length = 0;
  for (const ModelPoint& point : points) {
    const PosedPoint<float> posed = pose_point<float>(pose, point);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<float> edge = project_edge(posed, view.intrinsics);
    if (!on_image(edge, view.shape.width, view.shape.height)) continue;
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
  for (const VisibleInView& seen : visible_in_views(models, poses, views, backend, visibility)) {
    const std::size_t slot = problems.size(), v = slot % views.size();
    const Hypothesis& pose = poses[slot / views.size()];
    const Se3 camera_from_object = views[v].camera_from_world * pose.world_from_object;
    features[slot].visible = double(seen.unoccluded);
    features[slot].length_px =
        length_in_image_px(models[std::size_t(pose.object)], camera_from_object, *views[v].view, seen.points);
    problems.push_back({to_pose(camera_from_object), std::uint32_t(points.size()),
                        std::uint32_t(seen.points.size()), std::uint32_t(v)});
    points.insert(points.end(), seen.points.begin(), seen.points.end());
  }
  std::vector<ViewHandle> handles;
  for (const RegisterView& view : views) handles.push_back(view.view);
  std::vector<PoseScore> scores(problems.size());
  backend.pose_score(handles, points, problems, options, scores);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    PoseFeatures& f = features[i];
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
