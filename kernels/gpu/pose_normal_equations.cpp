#include "kernels/gpu/pose_normal_equations.h"

#include <algorithm>

#include "kernels/error.h"
#include "pose_normal_equations.spv.h"

namespace edgescout::gpu {

static_assert(sizeof(NormalEquations) == sizeof(float) * POSE_SYSTEM_SUMS);

PoseNormalEquations::PoseNormalEquations(const Device& device, std::uint32_t min_groups)
    : kernel_(device,
              {"pose_normal_equations", pose_normal_equations_spv, 7, sizeof(PoseSystemPush), {}}),
      min_groups_(min_groups > 0 ? min_groups : groups_to_fill(device)),
      device_(device),
      buffers_(device) {}

std::size_t PoseNormalEquations::that_fit(std::span<const PoseProblem> problems) const {
  return poses_that_fit(device_, problems, POSE_SYSTEM_SUMS);
}

void PoseNormalEquations::record(Batch& batch, std::span<const PoseView> views,
                                 const PosePoints& points, std::span<const PoseProblem> problems,
                                 const PoseLoss& loss) {
  plan_ = plan_poses(problems, points.count(), views.size(), min_groups_);
  buffers_.upload(batch, plan_, points, problems, POSE_SYSTEM_SUMS);
  for (const PosePlan::Run& run : plan_.runs) {
    const PoseView& view = views[run.view];
    const DeviceTensor& t = *view.tensor;
    const PoseSystemPush push{t.grid(),
                              pose_camera(view.intrinsics),
                              POSE_MIN_FORESHORTENING,
                              run.first,
                              plan_.parts,
                              loss.kind,
                              loss.scale_px};
    batch.dispatch(kernel_.of(t), {plan_.parts, run.count},
                   {t.band(0), t.band(1), t.band(2), t.band(3), buffers_.points(),
                    buffers_.problems(), buffers_.results()},
                   push);
  }
  buffers_.download(batch);
}

void PoseNormalEquations::collect(std::span<NormalEquations> out) const {
  check(out.size() == plan_.order.size(), "pose_normal_equations: as many systems as problems");
  double totals[POSE_SYSTEM_SUMS];
  for (std::size_t n = 0; n < plan_.order.size(); ++n) {
    buffers_.total(plan_, n, totals);
    NormalEquations& system = out[plan_.order[n]];
    std::copy(totals, totals + 21, system.hessian);
    std::copy(totals + 21, totals + 27, system.gradient);
    system.cost = float(totals[27]);
    system.residual_sum = float(totals[28]);
    system.weight_sum = float(totals[29]);
    system.points = float(totals[30]);
    system.behind = float(totals[31]);
  }
}

}  // namespace edgescout::gpu
