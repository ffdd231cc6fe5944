#include "host/core/lens.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "kernels/error.h"

namespace edgescout {

namespace {

using Eigen::Vector2d;

// p1, p2 move the point towards where the lens is decentred.
Vector2d tangential(const Vector2d& at, double p1, double p2) {
  const double r2 = at.squaredNorm(), xy = 2 * at.x() * at.y();
  return {p1 * xy + p2 * (r2 + 2 * at.x() * at.x()), p1 * (r2 + 2 * at.y() * at.y()) + p2 * xy};
}

// Projects onto a sensor that is turned by tau_x about x, then by tau_y about y.
Vector2d tilted(const Vector2d& at, double tau_x, double tau_y) {
  if (tau_x == 0 && tau_y == 0) return at;
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(-tau_y, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(-tau_x, Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  const Eigen::Vector3d turned = turn * at.homogeneous();
  return {(turn(2, 2) * turned.x() - turn(0, 2) * turned.z()) / turned.z(),
          (turn(2, 2) * turned.y() - turn(1, 2) * turned.z()) / turned.z()};
}

Vector2d brown_conrady(const LensCoefficients& c, const Vector2d& at) {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tau_x, tau_y] = c;
  const double r2 = at.squaredNorm();
  const double radial =
      (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  const Vector2d prism(r2 * (s1 + r2 * s2), r2 * (s3 + r2 * s4));
  return tilted(radial * at + tangential(at, p1, p2) + prism, tau_x, tau_y);
}

Vector2d modified_brown_conrady(const LensCoefficients& c, const Vector2d& at) {
  const double r2 = at.squaredNorm(), radial = 1 + r2 * (c[0] + r2 * (c[1] + r2 * c[4]));
  const Vector2d moved = radial * at;
  // librealsense adds the r^2 of the point before it was moved.
  const double xy = 2 * moved.x() * moved.y();
  return {moved.x() + c[2] * xy + c[3] * (r2 + 2 * moved.x() * moved.x()),
          moved.y() + c[3] * xy + c[2] * (r2 + 2 * moved.y() * moved.y())};
}

// (x, y) scaled so that its length is the angle from the axis.
Vector2d by_angle(const Vector2d& at) {
  const double r = at.norm();
  return r > 0 ? Vector2d(std::atan(r) / r * at) : at;
}

Vector2d fisheye(const LensCoefficients& c, const Vector2d& at) {
  const Vector2d angle = by_angle(at);
  const double a2 = angle.squaredNorm();
  double radial = 0;
  for (std::size_t i = 6; i-- > 0;) radial = a2 * (c[i] + radial);
  const Vector2d moved = (1 + radial) * angle;
  const double m2 = moved.squaredNorm();
  // Aria numbers the tangential terms the other way round: p1 belongs to x.
  return moved + tangential(moved, c[7], c[6]) +
         Vector2d(m2 * (c[8] + m2 * c[9]), m2 * (c[10] + m2 * c[11]));
}

Vector2d thin_prism_fisheye(const LensCoefficients& c, const Vector2d& at) {
  const auto [k1, k2, p1, p2, k3, k4, s1, s2] =
      std::tuple(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]);
  const Vector2d angle = by_angle(at);
  const double a2 = angle.squaredNorm();
  const double radial = a2 * (k1 + a2 * (k2 + a2 * (k3 + a2 * k4)));
  return (1 + radial) * angle + tangential(angle, p1, p2) + a2 * Vector2d(s1, s2);
}

Vector2d field_of_view(double omega, const Vector2d& at) {
  const double r = at.norm();
  if (r == 0 || omega == 0) return at;
  return std::atan(2 * r * std::tan(omega / 2)) / (omega * r) * at;
}

// Whether a step outwards is imaged as a step back.
bool folds_at(const Camera& camera, const Vector2d& at) {
  constexpr double step = 1e-5;
  const Vector2d here = distorted(camera, at);
  const Vector2d along_x = distorted(camera, at + Vector2d(step, 0)) - here,
                 along_y = distorted(camera, at + Vector2d(0, step)) - here;
  return along_x.x() * along_y.y() - along_x.y() * along_y.x() <= 0;
}

bool is_in_image(const Camera& camera, const Vector2d& pixel) {
  return pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < camera.width - 0.5 &&
         pixel.y() < camera.height - 0.5;
}

}  // namespace

Vector2d distorted(const Camera& camera, const Vector2d& direction) {
  switch (camera.lens) {
    case LensModel::BrownConrady:
      return brown_conrady(camera.distortion, direction);
    case LensModel::ModifiedBrownConrady:
      return modified_brown_conrady(camera.distortion, direction);
    case LensModel::Fisheye:
      return fisheye(camera.distortion, direction);
    case LensModel::ThinPrismFisheye:
      return thin_prism_fisheye(camera.distortion, direction);
    case LensModel::FieldOfView:
      return field_of_view(camera.distortion[0], direction);
  }
  throw LogicError("distorted: no such lens model");
}

Vector2d pixel_seeing(const Camera& camera, const Vector2d& direction) {
  const Vector2d at = distorted(camera, direction);
  return {camera.fx * at.x() + camera.skew * at.y() + camera.cx, camera.fy * at.y() + camera.cy};
}

std::optional<double> folds_at_px(const Camera& camera) {
  const Camera ideal = undistorted(camera);
  constexpr int steps = 64;
  std::optional<double> least;
  for (int row = 0; row <= steps; ++row)
    for (int column = 0; column <= steps; ++column) {
      const Vector2d pixel(camera.width * double(column) / steps - 0.5,
                           camera.height * double(row) / steps - 0.5);
      const Vector2d direction = ray_through(ideal, pixel).head<2>();
      if (!folds_at(camera, direction) || !is_in_image(camera, pixel_seeing(camera, direction)))
        continue;
      const double radius = (pixel - Vector2d(ideal.cx, ideal.cy)).norm();
      least = std::min(radius, least.value_or(radius));
    }
  return least;
}

std::string to_string(LensModel lens) {
  switch (lens) {
    case LensModel::BrownConrady:
      return "Brown-Conrady";
    case LensModel::ModifiedBrownConrady:
      return "modified Brown-Conrady";
    case LensModel::Fisheye:
      return "fisheye (Kannala-Brandt)";
    case LensModel::ThinPrismFisheye:
      return "thin prism fisheye";
    case LensModel::FieldOfView:
      return "field of view";
  }
  throw LogicError("to_string: no such LensModel");
}

}  // namespace edgescout
