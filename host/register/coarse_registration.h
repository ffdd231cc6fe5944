// Registers poses on coarse tensors, each on the level that suits its object's size.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

// The index of the view's reduction that suits the size of a model at a pose.
std::size_t level_of_pose(const ObjectView& view, const EdgeModel& model,
                          const Se3& camera_from_object);

// Registers poses in a scene whose views have the coarse tensors of one level.
using RegisterOnLevel = std::function<std::vector<PoseEstimate>(
    const Scene& scene, std::span<const ObjectPose> starts)>;

// Calls `register_on_level` once for each level that suits starts. The size is that in the first
// view. The order is that of the starts.
std::vector<PoseEstimate> register_coarsely(const Scene& scene, std::span<const ObjectPose> starts,
                                            const RegisterOnLevel& register_on_level);

// The same by register_poses.
std::vector<PoseEstimate> register_coarsely(const Scene& scene, std::span<const ObjectPose> starts,
                                            const D2coOptions& options);
// The same by register_on_templates: the poses are of the set's object.
std::vector<PoseEstimate> register_coarsely(const Scene& scene, const TemplateSet& set,
                                            std::span<const ObjectPose> starts,
                                            const D2coOptions& options);

}  // namespace edgescout
