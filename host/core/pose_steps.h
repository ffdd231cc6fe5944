// Steps of a minimisation over a pose, and the covariance at its end, in the tangent of se3.h.
#pragma once

#include "host/core/se3.h"

namespace edgescout {

bool is_small(const Vector6d& step, double min_step_m, double min_step_rad);

// By how much a step moves the points across their edges, from the weighted sum of the squares of
// its derivatives.
double rms_motion_px(const Vector6d& step, const Matrix6d& hessian, double weight_sum);

// Covariance of a pose from its final system: variance * hessian^-1, infinite where singular.
Matrix6d pose_covariance(const Matrix6d& hessian, double residual_variance);

}  // namespace edgescout
