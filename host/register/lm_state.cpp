#include "host/register/lm_state.h"

#include <algorithm>

#include "host/core/matrix6.h"
#include "host/core/pose_steps.h"

namespace edgescout {

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
  state.step = -solve(damped, state.system.gradient);
  if (!state.step.allFinite()) state.step.setZero();
  state.trial = retract(state.pose, state.step);
}

void accept_step(LmState& state, const WorldSystem& at_trial, double min_step_m,
                 double min_step_rad) {
  ++state.iterations;
  // Means, not sums: points that left through the camera plane must not count as progress.
  const bool better = at_trial.points > 0 && at_trial.mean_cost() < state.system.mean_cost();
  if (better) {
    state.pose = state.trial;
    state.system = at_trial;
    state.damping = std::max(1e-7, state.damping * 0.2);
  } else {
    state.damping *= 6;
  }
  if (is_small(state.step, min_step_m, min_step_rad))
    state.active = false, state.convergence = Convergence::Converged;
  if (!better && state.damping > 1e6)
    state.active = false, state.convergence = Convergence::NoDecrease;
}

void add_view(WorldSystem& sum, const NormalEquations& view, const Se3& camera_from_world) {
  WorldSystem in_camera;
  int entry = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b)
      in_camera.hessian(a, b) = in_camera.hessian(b, a) = view.hessian[entry++];
    in_camera.gradient[a] = view.gradient[a];
  }
  in_camera.cost = view.cost;
  in_camera.residual_sum = view.residual_sum;
  in_camera.weight_sum = view.weight_sum;
  in_camera.points = view.points;
  add_view(sum, in_camera, camera_from_world);
}

void add_view(WorldSystem& sum, const WorldSystem& in_camera, const Se3& camera_from_world) {
  Matrix6d camera_from_world_tangent = Matrix6d::Zero();
  camera_from_world_tangent.topLeftCorner<3, 3>() = camera_from_world.rotation.toRotationMatrix();
  camera_from_world_tangent.bottomRightCorner<3, 3>() =
      camera_from_world_tangent.topLeftCorner<3, 3>();
  WorldSystem in_world = in_camera;
  in_world.hessian =
      camera_from_world_tangent.transpose() * in_camera.hessian * camera_from_world_tangent;
  in_world.gradient = camera_from_world_tangent.transpose() * in_camera.gradient;
  sum += in_world;
}

WorldSystem& WorldSystem::operator+=(const WorldSystem& other) {
  hessian += other.hessian;
  gradient += other.gradient;
  cost += other.cost;
  residual_sum += other.residual_sum;
  weight_sum += other.weight_sum;
  points += other.points;
  depth_cost += other.depth_cost;
  depth_points += other.depth_points;
  return *this;
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
  result.last_step_px = rms_motion_px(state.step, system.hessian, system.weight_sum);
  result.covariance =
      pose_covariance(system.hessian, 2 * system.cost / std::max(1.0, system.weight_sum - 6));
  return result;
}

}  // namespace edgescout
