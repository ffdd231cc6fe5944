// D2CO once more with Ceres, one residual a point and one pose after the other: the judge of the
// batched solver in d2co.h.
//
// Same rounds, visible points, losses and covariance. Levenberg-Marquardt is Ceres' own: it stops
// by Ceres' measure of a small step, never larger than the options' (SmallStep), at the iteration
// limit, or where no step could be taken (NoDecrease). Tensors are copied to the host once a call,
// so any backend will do.
#pragma once

#include "host/register/d2co.h"

namespace edgescout {

std::vector<Registration> register_poses_ceres(std::span<const EdgeModel> models,
                                               std::span<const ObjectPose> hypotheses,
                                               std::span<const RegisterView> views,
                                               Backend& backend, const D2coOptions& options = {});

}  // namespace edgescout
