// Registers poses to sub-pixel edge points: associate every visible model point anew, then
// minimise.
//
// The tensor's seeds are whole pixels, and noise in an edge's direction disturbs its orientation
// term. Near the optimum this is more exact: every visible model point takes the nearest edge
// point, and Gauss-Newton with Geman-McClure weights minimises the distances to the edges'
// tangents.
#pragma once

#include <span>
#include <vector>

#include "host/register/edge_icp_options.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"

namespace edgescout {

// Improves every pose in place and gives it the covariance of edge_covariance.h. Views without an
// edge index do not take part. A pose with too few edges stays as it is. Sets the convergence,
// unless no view takes part.
void edge_icp(const Scene& scene, std::span<PoseEstimate> poses, const EdgeIcpOptions& options);

// Leaves a pose for a better optimum beside it (basin hopping): iterates from EdgeIcpOptions::hops,
// on the points that the pose shows, and takes the end that explains most of them
// (PoseEstimate::explained) if that is more than the pose explains. Returns the indices of those
// that have moved.
std::vector<std::size_t> hop_basins(const Scene& scene, std::span<PoseEstimate> poses,
                                    const EdgeIcpOptions& options);

}  // namespace edgescout
