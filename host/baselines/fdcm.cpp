#include "host/baselines/candidate_scores.h"
#include "host/baselines/visible_points.h"

namespace edgescout {

std::vector<double> fdcm_scores(std::span<const EdgeModel> models,
                                std::span<const Candidate> candidates, const RegisterView& view,
                                Backend& backend, const VisibilityOptions& visibility) {
  std::vector<ModelPoint> points;
  std::vector<PoseProblem> problems;
  for (const std::vector<ModelPoint>& list :
       visible_points(models, candidates, view, backend, visibility)) {
    const Candidate& candidate = candidates[problems.size()];
    problems.push_back({to_pose(candidate.camera_from_object), std::uint32_t(points.size()),
                        std::uint32_t(list.size()), 0});
    points.insert(points.end(), list.begin(), list.end());
  }
  PoseScoreOptions options;
  options.cap_px = view.view->options.cap_px;
  std::vector<PoseScore> scores(problems.size());
  backend.pose_score(std::span(&view.view, 1), points, problems, options, scores);
  std::vector<double> means;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    // The kernel's mean is over the points inside the image alone: few of them would make a good
    // score of a candidate that hardly shows.
    const double inside =
        problems[i].point_count > 0 ? double(scores[i].points) / problems[i].point_count : 0;
    means.push_back(inside * scores[i].mean_px + (1 - inside) * options.cap_px);
  }
  return means;
}

}  // namespace edgescout
