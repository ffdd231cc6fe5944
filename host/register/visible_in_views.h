// The edge points of objects that each of several views sees.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

struct VisibleInView {
  std::vector<ModelPoint> points;  // neither the object itself nor the view's occluders hide them
  std::size_t unoccluded = 0;      // how many there would be without occluders
};

// One entry a pose and view, views of one pose side by side. Points project inside the image or
// not.
std::vector<VisibleInView> visible_in_views(std::span<const EdgeModel> models,
                                            std::span<const ObjectPose> poses,
                                            std::span<const RegisterView> views, Backend& backend,
                                            const VisibilityOptions& visibility = {});

}  // namespace edgescout
