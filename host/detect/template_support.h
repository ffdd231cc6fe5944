// How well the images' edges support poses, by the points of their templates.
//
// It is cheaper than the features of poses (pose_features.h), for which a depth map is drawn per
// pose and view. Templates do not mark silhouettes: all points count as interior ones.
#pragma once

#include <span>
#include <vector>

#include "host/model/template_set.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"

namespace edgescout {

// Pooled over the views, in the order of the poses. Only `support`, `points` and `visible` are
// measured; mean_px is that of the estimate. scene.models holds the model of the set, the poses'
// object.
std::vector<PoseFeatures> template_support(const TemplateSet& set, const Scene& scene,
                                           const std::vector<PoseEstimate>& poses);

}  // namespace edgescout
