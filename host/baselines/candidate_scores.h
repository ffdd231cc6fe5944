// Scores given pose candidates by the two detectors that the paper compares: LINE-2D and FDCM (Sec.
// 6, "Object Detection").
//
// Both score a candidate only where it projects. Every candidate has a template of its own, made of
// the points that are visible at its pose. So no template is reused at another place of the image.
//
// The scene must have exactly one view: LogicError otherwise.
#pragma once

#include <span>
#include <vector>

#include "host/model/visible_edges.h"
#include "host/register/scene.h"

namespace edgescout {

struct Line2dOptions {
  // Of a template, evenly spread over its edges; [1, 63]: OpenCV sums their similarities in bytes.
  int features = 63;
  // Side of the square over which the image's directions are spread (T of the paper below); odd, in
  // [1, 15].
  int spread_px = 5;
  // Of OpenCV's 3 x 3 Sobel on the blurred image. Weaker gradients have no direction; >= 0.
  float weak_gradient = 10;
  VisibilityOptions visibility;
  void validate() const;  // InputError naming the field and the violated bound
};

// LINE-2D (Hinterstoisser et al., Gradient response maps for real-time detection of textureless
// objects, PAMI 34(5), 2012) by OpenCV's linemod. The score is the mean similarity between the
// template's gradient directions and near ones of the image, in [0, 100]; higher is better.
// Features outside the image count 0, and so does a candidate without visible points. LogicError: a
// view without its image.
std::vector<double> line2d_scores(const Scene& scene, std::span<const ObjectPose> candidates,
                                  const Line2dOptions& options = {});

// FDCM (Liu et al., IJRR 2012; Eq. 7). The score is the mean tensor value over the candidate's
// visible points, px; lower is better. Points outside the image count the tensor's cap, and so does
// a candidate without visible points.
std::vector<double> fdcm_scores(const Scene& scene, std::span<const ObjectPose> candidates,
                                const VisibilityOptions& visibility = {});

}  // namespace edgescout
