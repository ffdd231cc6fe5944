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

// Of poses that were registered in one view, which has depth and edges. Poses of which the depth
// has measured fewer than twenty samples are left out, and those whose edges do not hold them or
// lead to another pose.
std::vector<DepthOffset> depth_offsets(std::span<const EdgeModel> models, const ObjectView& view,
                                       Backend& backend, std::span<const ObjectPose> poses);

}  // namespace edgescout
