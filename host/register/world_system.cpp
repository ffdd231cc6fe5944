#include "host/register/world_system.h"

namespace edgescout {

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
  sum.hessian +=
      camera_from_world_tangent.transpose() * in_camera.hessian * camera_from_world_tangent;
  sum.gradient += camera_from_world_tangent.transpose() * in_camera.gradient;
  sum.cost += in_camera.cost;
  sum.residual_sum += in_camera.residual_sum;
  sum.weight_sum += in_camera.weight_sum;
  sum.points += in_camera.points;
}

}  // namespace edgescout
