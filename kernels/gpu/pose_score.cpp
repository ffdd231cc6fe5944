#include "kernels/gpu/pose_score.h"

#include "kernels/error.h"
#include "pose_score.spv.h"

namespace edgescout::gpu {

PoseScorer::PoseScorer(const Device& device, std::uint32_t min_groups)
    : kernel_(device, {"pose_score", pose_score_spv, 8, sizeof(PoseScorePush), {}}),
      min_groups_(min_groups > 0 ? min_groups : groups_to_fill(device)),
      device_(device),
      buffers_(device) {}

std::size_t PoseScorer::that_fit(std::span<const PoseProblem> problems) const {
  return poses_that_fit(device_, problems, POSE_SCORE_SUMS);
}

void PoseScorer::record(Batch& batch, std::span<const PoseView> views, const PosePoints& points,
                        std::span<const PoseProblem> problems, const PoseScoreOptions& options) {
  cap_px_ = options.cap_px;
  plan_ = plan_poses(problems, points.count(), views.size(), min_groups_);
  buffers_.upload(batch, plan_, points, problems, POSE_SCORE_SUMS);
  for (const PosePlan::Run& run : plan_.runs) {
    const PoseView& view = views[run.view];
    const DeviceTensor& t = *view.tensor;
    const PoseScorePush push{t.grid(),        pose_camera(view.intrinsics), run.first,
                             plan_.parts,     view.gradient_x2 ? 1u : 0u,   options.min_gradient,
                             options.match_px};
    const RawBuffer& gradient = view.gradient_x2 ? *view.gradient_x2 : buffers_.points();
    batch.dispatch(kernel_.of(t), {plan_.parts, run.count},
                   {t.band(0), t.band(1), t.band(2), t.band(3), buffers_.points(),
                    buffers_.problems(), buffers_.results(), gradient},
                   push);
  }
  buffers_.download(batch);
}

void PoseScorer::collect(std::span<PoseScore> out) const {
  check(out.size() == plan_.order.size(), "pose_score: as many scores as problems");
  double totals[POSE_SCORE_SUMS];
  for (std::size_t n = 0; n < plan_.order.size(); ++n) {
    buffers_.total(plan_, n, totals);
    const double points = totals[3];
    PoseScore& score = out[plan_.order[n]];
    score = {cap_px_, 0, 0, 0};
    if (points > 0)
      score = {float(totals[0] / points), float(totals[1] / points), float(totals[2] / points),
               float(points)};
  }
}

}  // namespace edgescout::gpu
