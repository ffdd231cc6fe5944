#include "host/register/d2co.h"

#include <limits>

#include <Eigen/Cholesky>

#include "host/register/d2co_ceres.h"
#include "host/register/lm_state.h"
#include "host/register/register_points.h"
#include "host/register/visible_in_views.h"

namespace edgescout {

std::vector<ModelPoint> thinned(const std::vector<ModelPoint>& points, int most) {
  if (most <= 0 || int(points.size()) <= most) return points;
  std::vector<ModelPoint> kept(most);
  for (int i = 0; i < most; ++i) kept[i] = points[std::size_t(i) * points.size() / most];
  return kept;
}

Matrix6d pose_covariance(const Matrix6d& hessian, double residual_variance) {
  const Eigen::LDLT<Matrix6d> factor(hessian);
  if (factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0)
    return residual_variance * factor.solve(Matrix6d::Identity());
  // Not infinity times the identity: zero times infinity is NaN.
  Matrix6d unknown = Matrix6d::Zero();
  unknown.diagonal().setConstant(std::numeric_limits<double>::infinity());
  return unknown;
}

std::vector<PoseEstimate> register_poses(const Scene& scene, std::span<const ObjectPose> starts,
                                         const D2coOptions& options) {
  if (options.solver == Solver::Ceres) return register_poses_ceres(scene, starts, options);
  check_problem(starts, scene.models.size(), scene.views);
  const auto points = [&](std::span<const ObjectPose> poses) {
    return visible_points(scene, poses, options.visibility);
  };
  return register_points(scene, starts, points, options);
}

}  // namespace edgescout
