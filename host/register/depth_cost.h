// One sample of the surface in one view with depth as a residual of Ceres.
//
// The residual is that of kernels/pose_depth.h, in standard deviations. The derivative is a second,
// independent implementation, in matrices. Private to host/register and its tests.
#pragma once

#include <ceres/sized_cost_function.h>

#include "host/core/se3.h"
#include "kernels/pose_depth.h"

namespace edgescout {

// Parameters: world_from_object in the order of se3_manifold.h. The depth behind `view` must
// outlive the cost. A sample that is turned away or not measured has a residual of 0, a hidden one
// HIDDEN_RESIDUAL: a pose must not gain by sinking into a surface.
inline constexpr double HIDDEN_RESIDUAL = 1e4;  // every loss has its largest value there

class DepthCost : public ceres::SizedCostFunction<1, 7> {
 public:
  DepthCost(const DepthView& view, const Se3& camera_from_world, const SurfacePoint& sample,
            const PoseDepthOptions& options);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  DepthView view_;
  Se3 camera_from_world_;
  Eigen::Vector3d point_m_, normal_;
  PoseDepthOptions options_;
};

}  // namespace edgescout
