// Conversions to the kernels' transform and camera.
//
// Public header.
#pragma once

#include "host/core/camera.h"
#include "host/core/se3.h"
#include "kernels/types.h"

namespace edgescout {

Pose to_pose(const Se3& b_from_a);
Intrinsics intrinsics_of(const Camera& camera);

}  // namespace edgescout
