#include "host/register/world_system.h"

namespace edgescout {

void add_view(WorldSystem& sum, const NormalEquations& view, const Se3& camera_from_world) {
  Matrix6d hessian;
  Vector6d gradient;
  int entry = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b) hessian(a, b) = hessian(b, a) = view.hessian[entry++];
    gradient[a] = view.gradient[a];
  }
  Matrix6d camera_from_world_tangent = Matrix6d::Zero();
  camera_from_world_tangent.topLeftCorner<3, 3>() = camera_from_world.rotation.toRotationMatrix();
  camera_from_world_tangent.bottomRightCorner<3, 3>() = camera_from_world_tangent.topLeftCorner<3, 3>();
  sum.hessian += camera_from_world_tangent.transpose() * hessian * camera_from_world_tangent;
  sum.gradient += camera_from_world_tangent.transpose() * gradient;
  sum.cost += view.cost;
  sum.residual_sum += view.residual_sum;
  sum.weight_sum += view.weight_sum;
  sum.points += view.points;
}

}  // namespace edgescout
