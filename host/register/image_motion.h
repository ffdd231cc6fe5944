// Derivative of the image position of a model point by the pose.
#pragma once

#include "host/core/se3.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

// Derivative of nx * u + ny * v by the camera's tangent (core/se3.h), where (u, v) is the
// projection of the point.
inline Vector6d image_motion(double nx, double ny, const PosedPoint<double>& p,
                             const Intrinsics& k) {
  const double z = p.point.z;
  const Vec3<double> by_point{nx * k.fx / z, ny * k.fy / z,
                              -(nx * k.fx * p.point.x + ny * k.fy * p.point.y) / (z * z)};
  const Vec3<double> by_turn = cross(p.arm, by_point);
  Vector6d motion;
  motion << by_point.x, by_point.y, by_point.z, by_turn.x, by_turn.y, by_turn.z;
  return motion;
}

}  // namespace edgescout
