// What shows of models at given poses. Private to host/baselines.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

// One list a hypothesis and view: [hypothesis * views + view].
std::vector<std::vector<ModelPoint>> visible_points(std::span<const EdgeModel> models,
                                                    std::span<const ObjectPose> hypotheses,
                                                    std::span<const RegisterView> views,
                                                    Backend& backend,
                                                    const VisibilityOptions& visibility);

// Of candidates in one view, one list each, in their order.
std::vector<std::vector<ModelPoint>> visible_points(std::span<const EdgeModel> models,
                                                    std::span<const Candidate> candidates,
                                                    const RegisterView& view, Backend& backend,
                                                    const VisibilityOptions& visibility);

}  // namespace edgescout
