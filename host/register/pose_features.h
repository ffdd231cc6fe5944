// Measures features that separate right poses from wrong ones.
//
// They are Psi (Eq. 10), mean tensor value and matched fraction over the visible points, and
// whether the grey inside the silhouette follows from the surface (shading.h).
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

// Rows are poses, columns views. background_psi is measured where there are several views.
Grid<PoseFeatures> features_by_view(const Scene& scene, std::span<const ObjectPose> poses,
                                    const FeatureOptions& options = {});

// The same into PoseEstimate::features.
void measure_features(const Scene& scene, std::span<PoseEstimate> poses,
                      const FeatureOptions& options = {});

// Pools the features of one pose over its views (at least one): means weighted by the views'
// numbers of points, sums of counts.
PoseFeatures pool_over_views(std::span<const PoseFeatures> by_view);

// Features of each pose pooled over all views, without background_psi.
std::vector<PoseFeatures> pooled_features(const Scene& scene, std::span<const ObjectPose> poses,
                                          const FeatureOptions& options = {});

// How far psi lies above chance: its excess over CHANCE_PSI in units of its standard error. The
// error falls with the square root of the visible edge length. Psi alone prefers small, simple
// views: two parallel lines match anywhere. Of two poses of one object the z-score prefers the one
// that shows more edges. CHANCE_PSI lies a little above the psi of unrelated directions, a mean
// |cos| of 2 / pi.
inline constexpr double CHANCE_PSI = 0.65;
double psi_z_score(const PoseFeatures& features);

// The same with background_psi in place of chance. The parallel lines of a barcode agree with an
// object at any place; blank surroundings agree with none.
double background_psi_z_score(const PoseFeatures& features);

}  // namespace edgescout
