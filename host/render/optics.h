// What the lens does to the light of an image. One function does each effect.
//
// The light is CV_32F; 1 is white.
#pragma once

#include <opencv2/core.hpp>

#include "host/core/camera.h"

namespace edgescout {

// Radial distortion that moves the corner of the image by so many pixels away from the principal
// point, and a point at a fraction f of the corner's distance by f^3 of that (k1 of Brown-Conrady).
class RadialDistortion {
 public:
  RadialDistortion(const Camera& camera, double corner_px);
  // Where a point of the distorted image lies without it.
  Eigen::Vector2d before(double x, double y) const;

 private:
  double cx_, cy_, k_;
};
void distort_radially(cv::Mat& light, const Camera& camera, double corner_px);

// Blurs by a disc of this radius. Below half a pixel nothing changes.
void defocus(cv::Mat& light, double radius_px);

// Blurs along a line of this length. The direction is measured from +x towards +y.
void blur_by_motion(cv::Mat& light, double length_px, double direction_rad);

// Darkens towards the corners, which lose this share of their light. The fall-off is that of
// natural vignetting, cos^4 of the angle to the axis.
void vignette(cv::Mat& light, double corner_loss);

// Multiplies the differences to the mean. Below 1 this is the veil of light that scatters in the
// lens.
void scale_contrast(cv::Mat& light, double factor);

}  // namespace edgescout
