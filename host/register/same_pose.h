// Decides whether two poses are one, by their centres and orientations.
//
// Symmetries are not asked (detect/suppression.h does): registrations of one start stay on its side.
#pragma once

#include "host/register/scene.h"
#include "host/register/thresholds.h"

namespace edgescout {

// Whether two poses of the scene's objects are of one object and differ by less than this.
bool is_same_pose(const ObjectPose& a, const ObjectPose& b, const Scene& scene,
                  const thresholds::PoseTolerance& tolerance);

}  // namespace edgescout
