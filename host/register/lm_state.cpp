#include "host/register/lm_state.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "host/register/d2co.h"
#include "kernels/error.h"

namespace edgescout {

void check_problem(std::span<const ObjectPose> starts, std::size_t models,
                   std::span<const ObjectView> views) {
  check(!views.empty(), "register_poses: at least one view");
  for (const ObjectView& view : views)
    check(is_finite(view.camera_from_world), "register_poses: a view whose pose is not finite");
  for (const ObjectPose& start : starts) {
    check(start.object >= 0 && static_cast<std::size_t>(start.object) < models,
          "register_poses: no such model");
    check(is_finite(start.world_from_object), "register_poses: a start that is not finite");
  }
}

void restart(LmState& state) {
  state.active = true;
  state.damping = 1e-3;
  state.trial = state.pose;
  state.convergence = Convergence::IterationLimit;
}

void initialize(LmState& state, const WorldSystem& system) {
  state.system = system;
  if (system.points == 0) state.active = false, state.convergence = Convergence::NoPoints;
}

void compute_step(LmState& state) {
  Matrix6d damped = state.system.hessian;
  const double floor = 1e-9 * damped.diagonal().maxCoeff();
  for (int i = 0; i < 6; ++i) damped(i, i) += state.damping * damped(i, i) + floor;
  state.step = -damped.ldlt().solve(state.system.gradient);
  if (!state.step.allFinite()) state.step.setZero();
  state.trial = retract(state.pose, state.step);
}

void accept_step(LmState& state, const WorldSystem& at_trial, double min_step_m,
                 double min_step_rad) {
  ++state.iterations;
  // Means, not sums: points that left through the camera plane must not count as progress.
  const bool better = at_trial.points > 0 &&
                      at_trial.cost / at_trial.points < state.system.cost / state.system.points;
  if (better) {
    state.pose = state.trial;
    state.system = at_trial;
    state.damping = std::max(1e-7, state.damping * 0.2);
  } else {
    state.damping *= 6;
  }
  if (is_small(state.step, min_step_m, min_step_rad))
    state.active = false, state.convergence = Convergence::SmallStep;
  if (!better && state.damping > 1e6)
    state.active = false, state.convergence = Convergence::NoDecrease;
}

bool is_small(const Vector6d& step, double min_step_m, double min_step_rad) {
  return step.head<3>().norm() < min_step_m && step.tail<3>().norm() < min_step_rad;
}

PoseEstimate estimate_of(const LmState& state, int object) {
  PoseEstimate result;
  result.object = object;
  result.world_from_object = state.pose;
  const WorldSystem& system = state.system;
  result.cost_px2 = system.cost;
  result.points = static_cast<int>(system.points);
  result.mean_px = system.points > 0 ? system.residual_sum / system.points : 0;
  result.iterations = state.iterations;
  result.convergence = state.convergence;
  result.covariance =
      pose_covariance(system.hessian, 2 * system.cost / std::max(1.0, system.weight_sum - 6));
  return result;
}

}  // namespace edgescout
