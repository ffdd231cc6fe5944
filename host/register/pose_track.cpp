#include "host/register/pose_track.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "kernels/error.h"

namespace edgescout {

void check_problem(std::span<const Hypothesis> starts, std::size_t models,
                   std::span<const RegisterView> views) {
  check(!views.empty(), "register_poses: at least one view");
  for (const RegisterView& view : views)
    check(is_finite(view.camera_from_world), "register_poses: a view whose pose is not finite");
  for (const Hypothesis& start : starts) {
    check(start.object >= 0 && static_cast<std::size_t>(start.object) < models,
          "register_poses: no such model");
    check(is_finite(start.world_from_object), "register_poses: a start that is not finite");
  }
}

void restart(PoseTrack& track) {
  track.active = true;
  track.damping = 1e-3;
  track.trial = track.pose;
  track.reason = Convergence::IterationLimit;
}

void begin_at(PoseTrack& track, const WorldSystem& system) {
  track.system = system;
  if (system.points == 0) track.active = false, track.reason = Convergence::NoPoints;
}

void propose(PoseTrack& track) {
  Matrix6d damped = track.system.hessian;
  const double floor = 1e-9 * damped.diagonal().maxCoeff();
  for (int i = 0; i < 6; ++i) damped(i, i) += track.damping * damped(i, i) + floor;
  track.step = -damped.ldlt().solve(track.system.gradient);
  if (!track.step.allFinite()) track.step.setZero();
  track.trial = retract(track.pose, track.step);
}

void judge(PoseTrack& track, const WorldSystem& at_trial, double min_step_m, double min_step_rad) {
  ++track.iterations;
  // Points that left through the camera plane must not look like progress: compare means.
  const bool better = at_trial.points > 0 &&
                      at_trial.cost / at_trial.points < track.system.cost / track.system.points;
  if (better) {
    track.pose = track.trial;
    track.system = at_trial;
    track.damping = std::max(1e-7, track.damping * 0.2);
  } else {
    track.damping *= 6;
  }
  if (is_small(track.step, min_step_m, min_step_rad))
    track.active = false, track.reason = Convergence::SmallStep;
  if (!better && track.damping > 1e6) track.active = false, track.reason = Convergence::NoDecrease;
}

bool is_small(const Vector6d& step, double min_step_m, double min_step_rad) {
  return step.head<3>().norm() < min_step_m && step.tail<3>().norm() < min_step_rad;
}

Registration registration_of(const PoseTrack& track) {
  Registration result;
  result.world_from_object = track.pose;
  const WorldSystem& system = track.system;
  result.cost_px2 = system.cost;
  result.points = static_cast<int>(system.points);
  result.mean_px = system.points > 0 ? system.residual_sum / system.points : 0;
  result.iterations = track.iterations;
  result.reason = track.reason;
  result.covariance =
      pose_covariance(system.hessian, 2 * system.cost / std::max(1.0, system.weight_sum - 6));
  return result;
}

}  // namespace edgescout
