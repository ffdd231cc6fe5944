#include "host/core/pose_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "host/core/matrix6.h"

namespace edgescout {

bool is_small(const Vector6d& step, double min_step_m, double min_step_rad) {
  return step.head<3>().norm() < min_step_m && step.tail<3>().norm() < min_step_rad;
}

double rms_motion_px(const Vector6d& step, const Matrix6d& hessian, double weight_sum) {
  return weight_sum > 0 ? std::sqrt(std::max(0.0, step.dot(hessian * step)) / weight_sum) : 0;
}

Matrix6d pose_covariance(const Matrix6d& hessian, double residual_variance) {
  if (const std::optional<Matrix6d> inverse = inverse_of_positive(hessian))
    return residual_variance * *inverse;
  // Not infinity times the identity: zero times infinity is NaN.
  Matrix6d unknown = Matrix6d::Zero();
  unknown.diagonal().setConstant(std::numeric_limits<double>::infinity());
  return unknown;
}

}  // namespace edgescout
