// By how much measured depth moves poses from where their edges alone hold them: the bias of a
// sensor, which the residuals of poses that were registered with its depth do not show.
#pragma once

#include <span>
#include <vector>

#include "host/register/scene.h"

namespace edgescout {

// Along the line of sight to the object's centre; positive: depth is farther away.
struct DepthOffset {
  double offset_m = 0;
  double sigma_m = 0;  // of the pose by edges alone, standard deviation
};

// Of poses that were registered with depth, in one view that has edges. Poses whose edges do not
// hold them, or lead to another pose, are left out.
std::vector<DepthOffset> depth_offsets(std::span<const EdgeModel> models, const ObjectView& view,
                                       Backend& backend, std::span<const ObjectPose> poses);

}  // namespace edgescout
