// What a lens does to the image of a direction.
//
// Public header.
#pragma once

#include <optional>
#include <string>

#include "host/core/camera.h"

namespace edgescout {

// Returns where the lens images the direction (x, y, 1), in units of the focal length. Without a
// lens this is (x, y). With r^2 = x^2 + y^2 and theta = atan(r):
//   BrownConrady          OpenCV's calib3d: radial (rational), tangential, thin prism, tilt
//   ModifiedBrownConrady  radial; then tangential with the point that the radial terms moved
//   Fisheye               theta (1 + k1 theta^2 + .. + k6 theta^12) along (x, y), as cv::fisheye;
//                         then tangential and thin prism with that point (Aria's FISHEYE624)
//   ThinPrismFisheye      theta along (x, y); then radial, tangential and thin prism as COLMAP
//   FieldOfView           atan(2 r tan(omega / 2)) / omega along (x, y)
Eigen::Vector2d distorted(const Camera& camera, const Eigen::Vector2d& direction);

// Returns the pixel of the original image that sees the direction (x, y, 1).
Eigen::Vector2d pixel_seeing(const Camera& camera, const Eigen::Vector2d& direction);

// Returns the least distance from the principal point, in px of the undistorted image, at which the
// lens folds the image: a direction further out is imaged further in. Only what lands in the
// original image counts. Empty: nowhere. The camera must have a size.
std::optional<double> folds_at_px(const Camera& camera);

// Returns a name for readers: "Brown-Conrady", "fisheye (Kannala-Brandt)" ..
std::string to_string(LensModel lens);

}  // namespace edgescout
