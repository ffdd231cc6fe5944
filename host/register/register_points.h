// D2CO on points that the caller looks up.
//
// register_poses draws depth maps to find the visible points. For short registrations that costs
// more than the registration itself.
#pragma once

#include <functional>

#include "host/core/grid.h"
#include "host/register/d2co.h"

namespace edgescout {

// The points of each pose that are visible in each view, object frame. Rows are poses, columns
// views.
using PointsInViews = std::function<Grid<std::vector<ModelPoint>>(std::span<const ObjectPose>)>;

// As register_poses, with points that it asks for before every round. Ignores scene.models,
// D2coOptions::visibility and D2coOptions::solver. LogicError besides: a grid of another size.
std::vector<PoseEstimate> register_points(const Scene& scene, std::span<const ObjectPose> starts,
                                          const PointsInViews& points,
                                          const D2coOptions& options = {});

}  // namespace edgescout
