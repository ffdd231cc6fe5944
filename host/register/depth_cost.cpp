#include "host/register/depth_cost.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/register/se3_manifold.h"

namespace edgescout {

namespace {

// Direction (z = 1) of the ray through the pixel nearest to a point, times the depth there.
std::optional<Eigen::Vector3d> measured_point(const DepthView& view, const Eigen::Vector3d& p) {
  const Intrinsics& k = view.intrinsics;
  const double u = std::floor(k.fx * p.x() / p.z() + k.cx + 0.5),
               v = std::floor(k.fy * p.y() / p.z() + k.cy + 0.5);
  if (!(u >= 0 && v >= 0 && u < view.width && v < view.height)) return {};
  const double z_m = view.z_m[std::size_t(v) * std::size_t(view.width) + std::size_t(u)];
  if (!(z_m > 0)) return {};
  return z_m * Eigen::Vector3d((u - k.cx) / k.fx, (v - k.cy) / k.fy, 1);
}

}  // namespace

DepthCost::DepthCost(const DepthView& view, const Se3& camera_from_world,
                     const SurfacePoint& sample, const PoseDepthOptions& options)
    : view_(view),
      camera_from_world_(camera_from_world),
      point_m_(sample.x_m, sample.y_m, sample.z_m),
      normal_(sample.nx, sample.ny, sample.nz),
      options_(options) {}

bool DepthCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  residuals[0] = 0;
  const bool wants_jacobian = jacobians && jacobians[0];
  if (wants_jacobian) std::fill_n(jacobians[0], 7, 0.0);
  const Se3 camera_from_object = camera_from_world_ * from_parameters(parameters[0]);
  const Eigen::Vector3d p = camera_from_object * point_m_,
                        n = camera_from_object.rotation * normal_;
  if (!(p.z() > POSE_MIN_DEPTH_M) || n.dot(p) > -MIN_FACING * p.norm()) return true;
  const std::optional<Eigen::Vector3d> q = measured_point(view_, p);
  if (!q || n.dot(*q) >= 0) return true;
  const double z_m = q->z(), slope = n.dot(*q) / z_m, offset_m = z_m - n.dot(p) / slope;
  const double sigma_m = std::max(double(options_.noise_floor_m), options_.noise_per_m * z_m * z_m);
  if (offset_m < -std::max(double(options_.band_m), BAND_SIGMAS * sigma_m)) {
    residuals[0] = HIDDEN_RESIDUAL;
    return true;
  }
  const double scale_m = std::hypot(sigma_m * slope, double(options_.surface_m));
  residuals[0] = n.dot(*q - p) / scale_m;
  if (!wants_jacobian) return true;
  Eigen::Matrix<double, 1, 6> by_tangent;
  by_tangent << -n.transpose(), -(*q - camera_from_object.translation_m).cross(n).transpose();
  Matrix6d camera_from_world = Matrix6d::Zero();
  camera_from_world.topLeftCorner<3, 3>() = camera_from_world.bottomRightCorner<3, 3>() =
      camera_from_world_.rotation.toRotationMatrix();
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> tangent_by_ambient;
  Se3Manifold().MinusJacobian(parameters[0], tangent_by_ambient.data());
  Eigen::Map<Eigen::Matrix<double, 1, 7>> out(jacobians[0]);
  out = by_tangent / scale_m * camera_from_world * tangent_by_ambient;
  return true;
}

}  // namespace edgescout
