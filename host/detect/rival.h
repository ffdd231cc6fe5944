// Finds the pose that took the place of one that detection lost (explain.h).
#pragma once

#include <optional>

#include "host/detect/edge_claims.h"
#include "host/detect/given_pose.h"

namespace edgescout {

// `report` says where the given pose was lost; `stages` are compared with it. None where no other
// pose stands in its place.
std::optional<Rival> find_rival(const LossReport& report, const Scene& scene,
                                const TemplateSet& set, const GivenPose& given,
                                const ComparedStages& stages, const EdgeClaimOptions& claims);

}  // namespace edgescout
