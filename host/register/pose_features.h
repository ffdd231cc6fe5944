// What tells a right pose from a wrong one: Psi (Eq. 10), mean tensor value and matched fraction over the visible points of all views.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

struct PoseFeatures {
  double psi = 0;         // means over the visible points of all views, weighted by their number
  double mean_px = 0;
  double matched = 0;     // fraction of points with a tensor value below the match limit
  double points = 0;      // inside the images
  double length_px = 0;   // of the visible edges in the images
  double in_image = 0;    // fraction of the visible points that project into the image
};

std::vector<PoseFeatures> pose_features(std::span<const EdgeModel> models, std::span<const Hypothesis> poses,
                                        std::span<const RegisterView> views, Backend& backend, const PoseScoreOptions& options,
                                        const VisibilityOptions& visibility = {});

}  // namespace edgescout
