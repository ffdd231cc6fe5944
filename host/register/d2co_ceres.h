// D2CO by Ceres: one residual per point, one pose after the other. Reference of the batched solver.
//
// Rounds, visible points, losses and covariance are those of register_poses. Levenberg-Marquardt is
// Ceres' own. It stops at a small step by Ceres' measure, which is never larger than the options'
// (SmallStep), at the iteration limit, or where no step could be taken (NoDecrease). Each call
// copies the tensors to the host, so it works with any backend.
#pragma once

#include "host/register/d2co.h"

namespace edgescout {

// As register_poses, which calls it for Solver::Ceres.
std::vector<PoseEstimate> register_poses_ceres(const Scene& scene,
                                               std::span<const ObjectPose> starts,
                                               const D2coOptions& options = {});

}  // namespace edgescout
