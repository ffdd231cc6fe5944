// Finds values of a calibration that are possible and hardly right.
//
// Public header.
#pragma once

#include <string>
#include <vector>

#include "host/core/camera.h"

namespace edgescout {

// Lists what is possible and hardly right, each as a text "FIELD: found X, expected Y": a lens that
// folds the image or moves it by more than its size, tangential coefficients as large as radial
// ones, a principal point far from the middle, pixels that are not square, a very wide or very
// narrow view, much skew. Without a size only what needs none.
std::vector<std::string> implausible_in(const Camera& camera);

// Returns the horizontal or the vertical angle that a pinhole camera sees, rad.
double horizontal_view_rad(const Camera& camera);
double vertical_view_rad(const Camera& camera);

}  // namespace edgescout
