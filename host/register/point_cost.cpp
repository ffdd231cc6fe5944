#include "host/register/point_cost.h"

#include <cmath>
#include <numbers>

#include "host/register/se3_manifold.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix<double, 2, 3> projection_by_point(const Intrinsics& k, const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << k.fx / p.z(), 0, -k.fx * p.x() / (p.z() * p.z()), 0, k.fy / p.z(),
      -k.fy * p.y() / (p.z() * p.z());
  return by_point;
}

double undirected(const Eigen::Vector2d& direction) {
  const double angle = std::atan2(direction.y(), direction.x());
  return angle < 0 ? angle + std::numbers::pi : angle;
}

// Derivative of (u, v, orientation) by [point, tangent] in the camera frame.
Eigen::Matrix<double, 3, 6> image_by_edge(const Intrinsics& k, const Eigen::Vector3d& p,
                                          const Eigen::Vector3d& tangent) {
  Eigen::Matrix<double, 3, 6> by_edge = Eigen::Matrix<double, 3, 6>::Zero();
  const Eigen::Matrix<double, 2, 3> by_point = projection_by_point(k, p);
  by_edge.topLeftCorner<2, 3>() = by_point;
  const Eigen::Vector2d d = by_point * tangent;
  if (d.norm() < POSE_MIN_FORESHORTENING * k.fx / p.z()) return by_edge;
  // z d = [fx (tx - tz x/z), fy (ty - tz y/z)] has the same direction as d. x/z and y/z have the
  // derivatives of the projection.
  Eigen::Matrix<double, 2, 6> by_both;
  by_both.leftCols<3>() = -tangent.z() * by_point;
  by_both.rightCols<3>() = p.z() * by_point;
  const Eigen::Vector2d scaled = p.z() * d;
  by_edge.row(2) = Eigen::RowVector2d(-scaled.y(), scaled.x()) / scaled.squaredNorm() * by_both;
  return by_edge;
}

}  // namespace

PointCost::PointCost(const TensorView& view, const Se3& camera_from_world, const ModelPoint& point)
    : view_(view),
      camera_from_world_(camera_from_world),
      point_m_(point.x_m, point.y_m, point.z_m),
      tangent_(point.tx, point.ty, point.tz) {}

bool PointCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const Se3 world_from_object = from_parameters(parameters[0]);
  const Eigen::Vector3d arm = world_from_object.rotation * point_m_,
                        tangent_in_world = world_from_object.rotation * tangent_;
  const Eigen::Vector3d p = camera_from_world_ * (arm + world_from_object.translation_m);
  const Eigen::Vector3d tangent = camera_from_world_.rotation * tangent_in_world;
  if (!(p.z() > POSE_MIN_DEPTH_M)) return false;
  const Intrinsics& k = view_.intrinsics;
  const Eigen::Vector2d direction = projection_by_point(k, p) * tangent;
  float slope[3];
  residuals[0] =
      tensor_lookup(view_, float(k.fx * p.x() / p.z() + k.cx), float(k.fy * p.y() / p.z() + k.cy),
                    float(undirected(direction)), slope);
  if (!jacobians || !jacobians[0]) return true;
  const Eigen::Matrix3d camera_from_world = camera_from_world_.rotation.toRotationMatrix();
  Matrix6d edge_by_pose = Matrix6d::Zero();
  edge_by_pose.topLeftCorner<3, 3>() = camera_from_world;
  edge_by_pose.topRightCorner<3, 3>() = -camera_from_world * cross_matrix(arm);
  edge_by_pose.bottomRightCorner<3, 3>() = -camera_from_world * cross_matrix(tangent_in_world);
  const Eigen::RowVector3d by_image(slope[0], slope[1], slope[2]);
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> tangent_by_ambient;
  Se3Manifold().MinusJacobian(parameters[0], tangent_by_ambient.data());
  Eigen::Map<Eigen::Matrix<double, 1, 7>> out(jacobians[0]);
  out = by_image * image_by_edge(k, p, tangent) * edge_by_pose * tangent_by_ambient;
  return true;
}

void GemanMcClureLoss::Evaluate(double t, double rho[3]) const {
  const double q = squared_scale_ / (squared_scale_ + t);
  rho[0] = q * t;
  rho[1] = q * q;
  rho[2] = -2 * q * q * q / squared_scale_;
}

std::unique_ptr<ceres::LossFunction> make_loss(const PoseLoss& loss) {
  if (loss.kind == LOSS_HUBER) return std::make_unique<ceres::HuberLoss>(loss.scale_px);
  check(loss.kind == LOSS_GEMAN_MCCLURE, "unknown loss");
  return std::make_unique<GemanMcClureLoss>(loss.scale_px);
}

}  // namespace edgescout
