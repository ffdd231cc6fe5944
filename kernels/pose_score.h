// How well many poses fit many views: mean tensor value (Eq. 7), gradient-direction score Psi (Eq.
// 10) and the fraction of points that find an edge.
//
// Per problem, over the points in front of the camera (pose_normal_equations.h) and inside the
// image, that is whose nearest pixel is one of it, -0.5 <= x < width - 0.5:
//   mean_px = mean of the trilinear tensor value (pose_normal_equations.h), in the rim of half a
//   pixel with
//             the distance to the border pixel added;
//   psi     = mean of |n . g| / |g|, n the unit normal of the projected edge, g the image gradient
//   at the
//             nearest pixel; a gradient weaker than `min_gradient` counts 0, not as chance (which
//             would give 0.64);
//   matched = fraction with a tensor value below match_px.
// No point inside: mean_px = PoseScoreOptions::cap_px, psi = matched = 0. A view without an image:
// psi = 0.
//
// Agreement: points equal; the means to 1e-3 px and 1e-3 (order of summation, atan2; a point on the
// threshold may fall on either side: matched to 2 / points). What float cannot keep is excepted: a
// point within 1e-3 px of the image's border may be inside on one path alone, one as near to the
// line between two pixels may read the gradient of either, and an edge seen end on
// (POSE_MIN_FORESHORTENING) has an orientation of rounding alone.
#pragma once

#include <span>

#include "kernels/pose_normal_equations.h"

namespace edgescout {

// Central differences (I(x+1) - I(x-1)) / 2, grey levels a pixel, as pairs [gx, gy]; zero on the
// border rows and columns.
std::vector<std::int16_t> image_gradient_x2(
    const ImageView& image);  // twice the gradient, exact integers

struct ScoreView {
  TensorView tensor;
  std::span<const std::int16_t> gradient_x2;  // width * height pairs
};

struct PoseScoreOptions {
  float min_gradient = 2.0f;  // grey levels a pixel
  float match_px = 6.0f;
  float cap_px = 60.0f;  // reported where nothing is inside
};

struct PoseScore {
  float mean_px;
  float psi;
  float matched;
  float points;  // inside the image and in front of the camera
};

void pose_score_reference(std::span<const ScoreView> views, std::span<const ModelPoint> points,
                          std::span<const PoseProblem> problems, const PoseScoreOptions& options,
                          std::span<PoseScore> out);
void pose_score_fast(std::span<const ScoreView> views, std::span<const ModelPoint> points,
                     std::span<const PoseProblem> problems, const PoseScoreOptions& options,
                     std::span<PoseScore> out, ThreadPool& pool);

}  // namespace edgescout
