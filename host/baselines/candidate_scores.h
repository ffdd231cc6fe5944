// Scores of given pose candidates by the two detectors that the paper compares (Sec. 6, "Object
// Detection"): LINE-2D and FDCM.
//
// Both look at a candidate where it projects and nowhere else: every candidate has a template of
// its own, made of the points that show from its pose, so that no template is taken to be the same
// at another place of the image.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

struct Line2dOptions {
  // of a template, evenly spread over its edges; [1, 63]: OpenCV adds up their similarities in
  // bytes
  int features = 63;
  int spread_px = 5;  // side of the square over which the image's directions are spread (T of the
                      // paper below); odd, in [1, 15]
  // of OpenCV's 3 x 3 Sobel on the blurred image: weaker ones have no direction; >= 0
  float weak_gradient = 10;
  VisibilityOptions visibility;
  void validate() const;  // throws InputError naming field and bound
};

// LINE-2D (Hinterstoisser et al., Gradient response maps for real-time detection of textureless
// objects, PAMI 34(5), 2012) by OpenCV's linemod: mean similarity of the template's gradient
// directions to those of the image near, in [0, 100], higher is better. Features outside the image
// count 0, as does a candidate without visible points. `view` must have its image: LogicError
// without.
std::vector<double> line2d_scores(std::span<const EdgeModel> models,
                                  std::span<const Candidate> candidates, const RegisterView& view,
                                  Backend& backend, const Line2dOptions& options = {});

// FDCM (Liu et al., IJRR 2012; Eq. 7): mean tensor value over the candidate's visible points, px,
// lower is better. Points outside the image count the tensor's cap, as does a candidate without
// visible points.
std::vector<double> fdcm_scores(std::span<const EdgeModel> models,
                                std::span<const Candidate> candidates, const RegisterView& view,
                                Backend& backend, const VisibilityOptions& visibility = {});

}  // namespace edgescout
