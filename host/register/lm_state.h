// One pose on its way through Levenberg-Marquardt, a step at a time, so that whoever sums the
// systems may do so for many poses at once.
#pragma once

#include "host/register/d2co.h"
#include "host/register/world_system.h"

namespace edgescout {

struct LmState {
  Se3 pose, trial;
  WorldSystem system;  // at `pose`
  Vector6d step = Vector6d::Zero();
  double damping = 1e-3;
  bool active = true;
  int iterations = 0;
  Convergence reason = Convergence::IterationLimit;
};

// LogicError for a start that is no pose or of no model, for no view or one that stands nowhere.
void check_problem(std::span<const ObjectPose> starts, std::size_t models,
                   std::span<const RegisterView> views);
// Before a round: the first trial is the pose itself.
void restart(LmState& state);
// With the system at the first trial: a pose without points in front of the camera goes no further.
void initialize(LmState& state, const WorldSystem& system);
// The next trial from the system at the pose. Marquardt's damping scales with the diagonal, so
// metres and radians are damped alike: by the image motion they cause.
void compute_step(LmState& state);
// Takes the trial where it lowered the mean cost; ends the state at a small step or where no step
// helps.
void accept_step(LmState& state, const WorldSystem& at_trial, double min_step_m,
                 double min_step_rad);
bool is_small(const Vector6d& step, double min_step_m, double min_step_rad);

Registration registration_of(const LmState& state);

}  // namespace edgescout
