// The pinhole camera with a lens.
//
// Camera frame: +z forward, +x right, +y down. Pixel centres are at integers: the image covers
// [-0.5, width - 0.5) x [-0.5, height - 0.5). The library undistorts every image once, on entry
// (io/image.h). All later code may assume that has_distortion() is false.
//
// Public header.
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

namespace edgescout {

// How a lens moves the image of a direction. core/lens.h has the formulas.
enum class LensModel {
  BrownConrady,          // OpenCV's: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y
  ModifiedBrownConrady,  // RealSense's: k1 k2 p1 p2 k3
  Fisheye,               // Kannala-Brandt: k1 .. k6 p1 p2 s1 .. s4
  ThinPrismFisheye,      // COLMAP's: k1 k2 p1 p2 k3 k4 s1 s2
  FieldOfView            // the angle omega, rad
};
using LensCoefficients = std::array<double, 14>;  // in the order of its model, the rest zero

struct Camera {
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  // px
  LensCoefficients distortion{};
  LensModel lens = LensModel::BrownConrady;
  double skew = 0;  // px: u = fx x + skew y + cx
  // Horizontal field of view of the undistorted image. 0: it keeps fx, fy, cx and cy.
  double field_of_view_rad = 0;
  // Returns whether undistorted(*this) differs: images must be resampled.
  bool has_distortion() const;
};

// Compares two cameras bit for bit. Images of one lens may have several sizes.
bool same_intrinsics(const Camera& a, const Camera& b);  // and lens, field of view
bool same_camera(const Camera& a, const Camera& b);      // intrinsics, lens and size

// Checks a camera. InputError naming `source` and the field: a size below 1, a value that is not
// finite, a focal length that is not positive, a principal point further from the image than one
// image size.
void validate(const Camera& camera, const std::string& source);

// Projects a point in the camera frame, z > 0; returns its ideal (undistorted) pixel.
Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& x_in_camera);
// Returns the direction (z = 1) of the ray through an undistorted pixel.
Eigen::Vector3d ray_through(const Camera& camera, const Eigen::Vector2d& pixel);
// Returns how many pixels a length across the line of sight spans, in the middle of the image.
double size_px(double length_m, double distance_m, const Camera& camera);
// Returns the distance at which the length spans so many pixels.
double distance_at_size_m(double length_m, double size_px, const Camera& camera);
// Returns the pinhole camera of the undistorted image, of the same size. With a chosen field of
// view its principal point is the middle of the image. LogicError: a chosen field of view without a
// size.
Camera undistorted(const Camera& camera);
// Returns the camera of an image resized by `factor`. The new size is rounded. With pixel centres
// at integers cx' = factor * (cx + 0.5) - 0.5.
Camera scaled(const Camera& camera, double factor);

}  // namespace edgescout
