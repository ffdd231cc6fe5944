// Lets the probable poses of one view hop to better optima beside them (edge_icp.h: hop_basins).
//
// Of one view only: several show the tilt and the distance of a pose well enough.
#pragma once

#include <span>

#include "host/register/edge_icp_options.h"
#include "host/register/pose_estimate.h"
#include "host/register/pose_features.h"
#include "host/register/scene.h"

namespace edgescout {

// Of estimates with features, after edge_icp. Many starts end at one pose: one of them hops, the
// most probable one, and the others take its end. Measures the features of those that move anew.
void hop_probable(const Scene& scene, std::span<PoseEstimate> estimates,
                  const EdgeIcpOptions& options, const FeatureOptions& measure);

}  // namespace edgescout
