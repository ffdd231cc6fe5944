// D2CO: registration of object poses directly on the DCD tensors of one or several views (paper,
// Secs. 4.1 and 4.3).
//
// Minimises E(pose) = sum over views, points of rho(DT3_view(x_i, xi_i)) by Levenberg-Marquardt
// over the tangent of core/se3.h at world_from_object (Eqs. 8 and 11). Projections and orientations
// are recomputed at every evaluation; the visible points at the start of every round. All poses of
// a call are refined side by side: one kernel call gives the systems of all of them in all views.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co_options.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"

namespace edgescout {

// Covariance of a pose from its final system: variance * hessian^-1 in the tangent of core/se3.h,
// infinite where singular.
Matrix6d pose_covariance(const Matrix6d& hessian, double residual_variance);

// Evenly; all of them where `most` is 0 or enough.
std::vector<ModelPoint> thinned(const std::vector<ModelPoint>& points, int most);

// Estimates in the order of the starts, without features. InputError: options out of bounds;
// LogicError: no view, a view or a start whose pose is not finite, an object without a model.
std::vector<PoseEstimate> register_poses(const Scene& scene, std::span<const ObjectPose> starts,
                                         const D2coOptions& options = {});

}  // namespace edgescout
