// What shows of pose candidates in one view. Private to host/baselines.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

// One list a candidate, in their order.
std::vector<std::vector<ModelPoint>> visible_points(std::span<const EdgeModel> models,
                                                    std::span<const Candidate> candidates,
                                                    const RegisterView& view, Backend& backend,
                                                    const VisibilityOptions& visibility);

}  // namespace edgescout
