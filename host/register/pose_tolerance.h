// Decides whether two poses lie within a tolerance, by their centres and orientations.
//
// Symmetries play no part (detect/distinct_poses.h): starts of one part stay on their side.
#pragma once

#include "host/register/scene.h"
#include "host/register/thresholds.h"

namespace edgescout {

// Whether two poses of the scene's objects are of one object and differ by less than this.
bool is_same_pose(const ObjectPose& a, const ObjectPose& b, const Scene& scene,
                  const thresholds::PoseTolerance& tolerance);

}  // namespace edgescout
