// D2CO on points that the caller looks up: where poses are looked at briefly, drawing the depth
// maps that tell which points show would cost more than the registration itself.
#pragma once

#include <functional>

#include "host/register/d2co.h"

namespace edgescout {

// The points of each pose that show in each view, object frame; views of one pose side by side.
using PointsInViews =
    std::function<std::vector<std::vector<ModelPoint>>(std::span<const ObjectPose>)>;

// As register_poses; asked for the points before every round. D2coOptions::visibility plays no
// part.
std::vector<Registration> register_points(std::span<const ObjectPose> hypotheses,
                                          std::span<const RegisterView> views,
                                          const PointsInViews& points, Backend& backend,
                                          const D2coOptions& options = {});

}  // namespace edgescout
