#include "host/core/kernel_types.h"

namespace edgescout {

Intrinsics intrinsics_of(const Camera& c) {
  return {float(c.fx), float(c.fy), float(c.cx), float(c.cy)};
}

Pose to_pose(const Se3& b_from_a) {
  const Eigen::Matrix3d r = b_from_a.rotation.toRotationMatrix();
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.m[4 * i + j] = float(r(i, j));
    pose.m[4 * i + 3] = float(b_from_a.translation_m[i]);
  }
  return pose;
}

}  // namespace edgescout
