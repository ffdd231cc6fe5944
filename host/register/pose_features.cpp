#include "host/register/pose_features.h"

namespace edgescout {

namespace {

struct Slot {
  std::size_t pose;
  double visible;
};

void add(PoseFeatures& sum, const PoseScore& score) {
  sum.psi += double(score.psi) * score.points;
  sum.mean_px += double(score.mean_px) * score.points;
  sum.matched += double(score.matched) * score.points;
  sum.points += score.points;
}

}  // namespace

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
        slots.push_back({p, 0});
      }
    const std::vector<std::vector<ModelPoint>> visible = visible_edges(models[object], in_camera, backend, visibility);
    for (std::size_t i = 0; i < visible.size(); ++i) {
      problems[first + i].first_point = static_cast<std::uint32_t>(points.size());
      problems[first + i].point_count = static_cast<std::uint32_t>(visible[i].size());
      slots[first + i].visible = double(visible[i].size());
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
