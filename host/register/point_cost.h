// One model point in one view as a residual of Ceres.
//
// The residual is the tensor's value in px at the point's projection, as
// kernels/pose_normal_equations.h defines it. The derivative is a second, independent
// implementation, in matrices. Private to host/register and its tests.
#pragma once

#include <memory>

#include <ceres/loss_function.h>
#include <ceres/sized_cost_function.h>

#include "host/core/se3.h"
#include "kernels/pose_normal_equations.h"

namespace edgescout {

// Parameters: world_from_object in the order of se3_manifold.h. The tensor behind `view` must
// outlive the cost. Poses that bring the point to POSE_MIN_DEPTH_M or nearer cannot be evaluated:
// Ceres rejects such a step.
class PointCost : public ceres::SizedCostFunction<1, 7> {
 public:
  PointCost(const TensorView& view, const Se3& camera_from_world, const ModelPoint& point);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TensorView view_;
  Se3 camera_from_world_;
  Eigen::Vector3d point_m_, tangent_;
};

// Geman-McClure in Ceres' form, twice rho as a function of the squared residual t:
// s^2 t / (s^2 + t).
class GemanMcClureLoss : public ceres::LossFunction {
 public:
  explicit GemanMcClureLoss(double scale_px) : squared_scale_(scale_px * scale_px) {}
  void Evaluate(double squared_residual, double rho[3]) const override;

 private:
  double squared_scale_;
};

// The loss is twice the rho of the kernel's header.
std::unique_ptr<ceres::LossFunction> make_loss(const PoseLoss& loss);

}  // namespace edgescout
