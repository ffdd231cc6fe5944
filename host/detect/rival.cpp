#include "host/detect/rival.h"

#include <algorithm>

#include "host/detect/distinct_poses.h"
#include "host/register/thresholds.h"

namespace edgescout {

namespace {

class Rivals {
 public:
  Rivals(const Scene& scene, const TemplateSet& set, const GivenPose& given,
         const ComparedStages& stages, const EdgeClaimOptions& claims)
      : scene_(scene), set_(set), given_(given), stages_(stages), claims_(claims) {}

  std::optional<Rival> of(const LossReport& report) const {
    switch (report.lost_at) {
      case LossStage::Alignment:
        return Rival{*report.alignment.best_hit_became};
      case LossStage::Ranking:
        return best_claimant(stages_.medium.poses[*stages_.medium.best_same(rank_of)],
                             stages_.candidates.poses);
      case LossStage::Refinement:
        return Rival{*report.refinement.nearest};
      case LossStage::Selection:
        return winner();
      default:
        return std::nullopt;
    }
  }

 private:
  std::optional<Rival> winner() const {
    const std::vector<PoseEstimate>& competing = stages_.competing.poses;
    const std::optional<std::size_t> lost = stages_.competing.best_same(probability_of);
    if (!lost) return better_duplicate();
    std::optional<Rival> winner =
        best_claimant(competing[*lost], selected_estimates(stages_.selection));
    if (winner)
      winner->is_restarted =
          std::any_of(competing.begin() + std::ptrdiff_t(stages_.selection.first_restarted),
                      competing.end(), [&](const PoseEstimate& p) { return is_copy(p, *winner); });
    return winner;
  }

  // Of the poses that are not the same as the given one, that which claims most of the edges that
  // the lost pose explains. None where no pose claims any.
  std::optional<Rival> best_claimant(const ObjectPose& lost,
                                     const std::vector<PoseEstimate>& poses) const {
    std::optional<Rival> best;
    for (const PoseEstimate& pose : poses) {
      if (given_.of_bounds(pose) < 1) continue;
      const ObjectPose claimant = pose;
      const double claimed = claimed_fraction(scene_, lost, {&claimant, 1}, claims_);
      if (claimed > (best ? best->claimed : 0)) best = Rival{given_.found(pose), claimed};
    }
    return best;
  }

  // The best of the poses after the fine stage that are one pose with the lost one to detection.
  std::optional<Rival> better_duplicate() const {
    const Mesh& mesh = set_.model.mesh;
    const PoseEstimate& lost = stages_.fine.poses[*stages_.fine.best_same(probability_of)];
    const PoseEstimate* best = nullptr;
    for (const PoseEstimate& pose : stages_.fine.poses)
      if (probability_of(pose) >= probability_of(best ? *best : lost) &&
          pose_distance_m(pose.world_from_object, lost.world_from_object, mesh, set_.symmetries) <
              thresholds::SAME_POSE * mesh.diameter_m)
        best = &pose;
    return Rival{given_.found(*best)};
  }

  const Scene& scene_;
  const TemplateSet& set_;
  const GivenPose& given_;
  const ComparedStages& stages_;
  const EdgeClaimOptions& claims_;
};

}  // namespace

std::optional<Rival> find_rival(const LossReport& report, const Scene& scene,
                                const TemplateSet& set, const GivenPose& given,
                                const ComparedStages& stages, const EdgeClaimOptions& claims) {
  return Rivals(scene, set, given, stages, claims).of(report);
}

}  // namespace edgescout
