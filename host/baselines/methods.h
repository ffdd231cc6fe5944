// One pose at a time by each method that works point by point. Private to host/baselines and its tests.
#pragma once

#include "host/baselines/baseline.h"
#include "host/register/pose_track.h"

namespace edgescout {

// From a start (world_from_object) and its visible points, a list a view.
using PoseSolver =
    std::function<PoseTrack(const Se3& start, std::span<const std::vector<ModelPoint>> points)>;

PoseSolver prepare_dc_icp(std::span<const RegisterView> views, const BaselineOptions& options);
PoseSolver prepare_lm_icp(std::span<const RegisterView> views, const BaselineOptions& options);
PoseSolver prepare_c_icp(std::span<const RegisterView> views, const BaselineOptions& options);
PoseSolver prepare_direct(std::span<const RegisterView> views, const BaselineOptions& options);

}  // namespace edgescout
