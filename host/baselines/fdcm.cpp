#include "host/baselines/candidate_scores.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"

namespace edgescout {

std::vector<double> fdcm_scores(const Scene& scene, std::span<const ObjectPose> candidates,
                                const VisibilityOptions& visibility) {
  check(scene.views.size() == 1, "fdcm: exactly one view");
  const ObjectView& view = scene.views[0];
  const Grid<std::vector<ModelPoint>> visible = visible_points(scene, candidates, visibility);
  std::vector<ModelPoint> points;
  std::vector<PoseProblem> problems;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::vector<ModelPoint>& list = visible(i, 0);
    problems.push_back({to_pose(view.camera_from_world * candidates[i].world_from_object),
                        std::uint32_t(points.size()), std::uint32_t(list.size()), 0});
    points.insert(points.end(), list.begin(), list.end());
  }
  PoseScoreOptions options;
  options.cap_px = view.tensor->options.cap_px;
  std::vector<PoseScore> scores(problems.size());
  scene.backend.pose_score(std::span(&view.tensor, 1), points, problems, options, scores);
  std::vector<double> means;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    // The kernel averages over the points inside the image alone. Without this a candidate with few
    // points inside could score well.
    const double inside =
        problems[i].point_count > 0 ? double(scores[i].points) / problems[i].point_count : 0;
    means.push_back(inside * scores[i].mean_px + (1 - inside) * options.cap_px);
  }
  return means;
}

}  // namespace edgescout
