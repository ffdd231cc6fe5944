// Sums the systems of one pose in several camera frames into one 6x6 system in the world's tangent.
#pragma once

#include "host/core/se3.h"
#include "kernels/pose_normal_equations.h"

namespace edgescout {

struct WorldSystem {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double cost = 0;
  double residual_sum = 0;
  double weight_sum = 0;
  double points = 0;
};

// A step [dt, dw] in the world's tangent is [R dt, R dw] in the camera's, R being the rotation of
// camera_from_world: both parts of the tangent act on the left and about the object's origin.
void add_view(WorldSystem& sum, const NormalEquations& view, const Se3& camera_from_world);
// The same for a system in double with both triangles of the Hessian filled.
void add_view(WorldSystem& sum, const WorldSystem& in_camera, const Se3& camera_from_world);

}  // namespace edgescout
