// Which objects can say whether a camera pose is right.
#pragma once

#include <span>
#include <vector>

#include "host/active/scout_state.h"

namespace edgescout {

// In the world: the instances reported now, and where none of them lies those reported after
// earlier images, the latest word on each place. An image from a grossly wrong pose makes the
// belief in all instances vanish: only those believed in before it can tell.
std::vector<ObjectPose> reference_objects(std::span<const EdgeModel> models,
                                          std::span<const ScoutStep> earlier,
                                          std::span<const ModeDetection> now);

}  // namespace edgescout
