// The pinhole camera with Brown-Conrady distortion.
//
// Camera frame: +z forward, +x right, +y down. Pixel centres sit at integers: the image covers
// [-0.5, width - 0.5) x [-0.5, height - 0.5). Inside the library images are undistorted once, on
// entry (io/image.h), so everything downstream may assume `distortion` to be zero.
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

namespace edgescout {

struct Camera {
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  // px
  std::array<double, 8> distortion{};     // k1 k2 p1 p2 k3 k4 k5 k6, OpenCV's order
  bool has_distortion() const;
};

// Bit for bit; images of one lens may be of several sizes.
bool same_intrinsics(const Camera& a, const Camera& b);  // and distortion
bool same_camera(const Camera& a, const Camera& b);      // and size

// Throws InputError naming `source` and the field: size below 1, a value not finite, focal length
// not positive, principal point further from the image than one image size.
void validate(const Camera& camera, const std::string& source);

// Ideal (undistorted) projection of a point in the camera frame, z > 0; px.
Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& x_in_camera);
// Direction (z = 1) of the ray through an undistorted pixel.
Eigen::Vector3d ray_through(const Camera& camera, const Eigen::Vector2d& pixel);
// The same camera without distortion.
Camera undistorted(const Camera& camera);
// The camera of an image resized by `factor` (new size = rounded factor * size); pixel centres at
// integers make cx' = factor * (cx + 0.5) - 0.5.
Camera scaled(const Camera& camera, double factor);

}  // namespace edgescout
