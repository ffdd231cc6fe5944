// The state of Levenberg-Marquardt for one pose, advanced step by step.
//
// The caller sums the systems and may do so for many poses at once.
#pragma once

#include "host/register/d2co_options.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"
#include "host/register/world_system.h"

namespace edgescout {

struct LmState {
  Se3 pose, trial;
  WorldSystem system;  // at `pose`
  Vector6d step = Vector6d::Zero();
  double damping = 1e-3;
  bool active = true;
  int iterations = 0;
  Convergence convergence = Convergence::IterationLimit;
};

// LogicError: no view, a view or a start whose pose is not finite, an object without a model.
void check_problem(std::span<const ObjectPose> starts, std::size_t models,
                   std::span<const ObjectView> views);
// Begins a round: the first trial is the pose itself.
void restart(LmState& state);
// Takes the system at the first trial. Ends the state where no point lies in front of the camera.
void initialize(LmState& state, const WorldSystem& system);
// Computes the next trial from the system at the pose. Marquardt's damping scales with the
// diagonal: metres and radians are damped equally, by the image motion that they cause.
void compute_step(LmState& state);
// Takes the trial if it lowers the mean cost. Ends the state at a small step, or where no step
// lowers the cost.
void accept_step(LmState& state, const WorldSystem& at_trial, double min_step_m,
                 double min_step_rad);
bool is_small(const Vector6d& step, double min_step_m, double min_step_rad);

PoseEstimate estimate_of(const LmState& state, int object);

}  // namespace edgescout
