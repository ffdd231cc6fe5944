// The state of Levenberg-Marquardt for one pose, advanced step by step.
//
// The caller sums the systems and may do so for many poses at once.
#pragma once

#include "host/register/d2co_options.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"
#include "kernels/pose_normal_equations.h"

namespace edgescout {

struct WorldSystem {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double cost = 0;
  double residual_sum = 0;
  double weight_sum = 0;
  double points = 0;
  // Of samples of the surface against measured depth, in standard deviations squared; 0 without.
  double depth_cost = 0;
  double depth_points = 0;
  WorldSystem& operator+=(const WorldSystem& other);
  double mean_cost() const { return (cost + depth_cost) / (points + depth_points); }
};

// A step [dt, dw] in the world's tangent is [R dt, R dw] in the camera's, R being the rotation of
// camera_from_world: both parts of the tangent act on the left and about the object's origin.
void add_view(WorldSystem& sum, const NormalEquations& view, const Se3& camera_from_world);
// The same for a system in double with both triangles of the Hessian filled.
void add_view(WorldSystem& sum, const WorldSystem& in_camera, const Se3& camera_from_world);

struct LmState {
  Se3 pose, trial;
  WorldSystem system;  // at `pose`
  Vector6d step = Vector6d::Zero();
  double damping = 1e-3;
  bool active = true;
  int iterations = 0;
  Convergence convergence = Convergence::IterationLimit;
};

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

PoseEstimate estimate_of(const LmState& state, int object);

}  // namespace edgescout
