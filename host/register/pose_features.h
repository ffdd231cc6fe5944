// What tells a right pose from a wrong one: Psi (Eq. 10), mean tensor value and matched fraction
// over the visible points of all views, and whether the grey inside the silhouette follows from the
// surface (shading.h).
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"
#include "host/register/shading.h"

namespace edgescout {

struct PoseFeatures {
  double psi = 0;  // means over the visible points of all views, weighted by their number
  // psi where the object is not: of the same points, the pose moved a little aside. Only of several
  // views, by view (pose_features_by_view).
  double background_psi = 0;
  double mean_px = 0;
  double matched = 0;    // fraction of points with a tensor value below the match limit
  double points = 0;     // inside the images
  double length_px = 0;  // of the visible edges, as far as they lie in the images
  double in_image = 0;   // fraction of the visible points in the image that no known object hides
  double visible = 0;    // points that show from the camera, inside the image or not
  Shading shading;       // nothing compared where the view has no image
};

// How far above chance the agreement is: psi's excess over 0.65, a little above that of unrelated
// directions (a mean |cos| of 2 / pi = 0.64), in units of its standard error, which falls with the
// square root of the edge length seen. Psi alone prefers small, simple views (two parallel lines
// match anywhere); the excess times the length prefers, of two poses of one object, the one that
// shows more edges.
inline constexpr double CHANCE_PSI = 0.65;
double psi_z_score(const PoseFeatures& features);

// The same over what agrees beside the pose: a barcode, whose lines all run one way, agrees with an
// object wherever it stands, blank surroundings with none.
double background_psi_z_score(const PoseFeatures& features);

// Log-odds that the pose is right: a linear function of the logarithm of the evidence, the mean
// distance and the unexplained grey, fitted on rendered scenes (docs/evaluation.md says how). What
// candidates of one view are ranked by; of several views: merit (detect/probability_over_views.h).
double log_odds(const PoseFeatures& features);

// One entry a pose and view, views of one pose side by side.
std::vector<PoseFeatures> pose_features_by_view(std::span<const EdgeModel> models,
                                                std::span<const ObjectPose> poses,
                                                std::span<const RegisterView> views,
                                                Backend& backend, const PoseScoreOptions& options,
                                                const VisibilityOptions& visibility = {});

// Those of several views (at least one) of a pose together.
PoseFeatures pool_over_views(std::span<const PoseFeatures> by_view);

std::vector<PoseFeatures> pose_features(std::span<const EdgeModel> models,
                                        std::span<const ObjectPose> poses,
                                        std::span<const RegisterView> views, Backend& backend,
                                        const PoseScoreOptions& options,
                                        const VisibilityOptions& visibility = {});

}  // namespace edgescout
