// Which objects the camera poses are checked by (extrinsics_check.h).
#pragma once

#include <span>
#include <vector>

#include "host/active/scout_state.h"

namespace edgescout {

// In the world: the instances reported now and, where none of them lies, those reported after
// earlier images, in each place the latest. An image with a grossly wrong camera pose makes the
// probability of all instances vanish; only instances that were reported before can reveal it.
std::vector<ObjectPose> reference_objects(std::span<const EdgeModel> models,
                                          std::span<const ScoutStep> earlier,
                                          std::span<const ModeDetection> now);

}  // namespace edgescout
