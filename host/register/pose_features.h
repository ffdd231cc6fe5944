// Measures features that separate right poses from wrong ones.
//
// They are Psi (Eq. 10), mean tensor value and matched fraction over the visible points, whether
// the grey inside the silhouette follows from the surface (shading.h), and whether the image's
// edges support the pose more than its surroundings (edge_support.h).
//
// Public header.
#pragma once

#include <span>
#include <vector>

#include "host/core/grid.h"
#include "host/model/visible_edges.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"

namespace edgescout {

// What the features are measured with.
struct FeatureOptions {
  PoseScoreOptions score{1.0f, 4.0f, 60.0f};
  VisibilityOptions visibility;
};

// Measures the features of each pose in each view. Rows are poses, columns views.
Grid<PoseFeatures> features_by_view(const Scene& scene, std::span<const ObjectPose> poses,
                                    const FeatureOptions& options = {});

// Measures the same into PoseEstimate::features and classifies them (pose_classifier.h).
void measure_features(const Scene& scene, std::span<PoseEstimate> poses,
                      const FeatureOptions& options = {});

// Returns the features of each pose pooled over all views.
std::vector<PoseFeatures> pooled_features(const Scene& scene, std::span<const ObjectPose> poses,
                                          const FeatureOptions& options = {});

}  // namespace edgescout
