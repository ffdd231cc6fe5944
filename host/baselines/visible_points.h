// Visible points of poses of several models. Private to host/baselines.
#pragma once

#include "host/model/visible_edges.h"

namespace edgescout {

// One list a pose, in their order; objects[i] is the model of camera_from_object[i].
std::vector<std::vector<ModelPoint>> visible_points(std::span<const EdgeModel> models,
                                                    std::span<const int> objects,
                                                    std::span<const Se3> camera_from_object, Backend& backend,
                                                    const VisibilityOptions& visibility);

}  // namespace edgescout
