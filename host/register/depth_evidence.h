// Whether measured depth agrees with the surface that a pose shows.
#pragma once

#include <span>

#include "host/register/pose_estimate.h"
#include "host/register/scene.h"
#include "host/register/visible_in_views.h"

namespace edgescout {

DepthEvidence evidence_of(const PoseDepth& compared);

// Rows are poses, columns views. All zero where the view has no depth.
Grid<DepthEvidence> depth_evidence(const Scene& scene, std::span<const ObjectPose> poses,
                                   PointsInViews<SurfacePoint> surface);
// `visible` is that of the poses (visible_in_views).
Grid<DepthEvidence> depth_evidence(const Scene& scene, std::span<const ObjectPose> poses,
                                   const Grid<VisibleInView>& visible);

// Whether the surface cannot be where the pose has it: of the samples that were measured and that
// nothing hides, at least twenty, the sensor saw behind more than half. Of one view, or pooled over
// views.
bool is_contradicted(const DepthEvidence& evidence);

}  // namespace edgescout
