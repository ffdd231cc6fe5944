#include "host/track/surface_fit.h"

#include <utility>

#include "host/register/depth_evidence.h"

namespace edgescout {

SurfaceFit::SurfaceFit(const MeasuredDepth& depth, const Camera& ideal, const EdgeModel& model,
                       std::vector<SurfacePoint> visible, ThreadPool& threads)
    : depth_(&depth),
      intrinsics_(intrinsics_of(ideal)),
      diameter_m_(model.mesh.diameter_m),
      visible_(std::move(visible)),
      threads_(&threads) {}

PoseDepth SurfaceFit::compared(const Se3& camera_from_object, double band,
                               double loss_sigmas) const {
  const DepthImage& image = depth_->image;
  const DepthView view{image.z_m, image.width, image.height, intrinsics_};
  const PoseProblem problem{to_pose(camera_from_object), 0, std::uint32_t(visible_.size()), 0};
  PoseDepthOptions options = pose_depth_options(depth_->noise, diameter_m_, band);
  options.loss_scale = float(loss_sigmas);
  PoseDepth found;
  pose_depth_fast({&view, 1}, visible_, {&problem, 1}, options, {&found, 1}, *threads_);
  return found;
}

WorldSystem SurfaceFit::system_at(const Se3& camera_from_object, double loss_sigmas) const {
  const PoseDepth found = compared(camera_from_object, REGISTRATION_BAND, loss_sigmas);
  WorldSystem system = world_system(found, Se3{}, loss_sigmas);
  const double share = independent_share(double(found.weight_sum));
  system.hessian *= share;
  system.gradient *= share;
  return system;
}

void SurfaceFit::add_information(Matrix6d& covariance, const Se3& camera_from_object) const {
  constexpr double loss_sigmas = PoseDepthOptions{}.loss_scale;
  const PoseDepth found = compared(camera_from_object, REGISTRATION_BAND, loss_sigmas);
  add_depth_information(covariance, world_system(found, Se3{}, loss_sigmas).hessian,
                        double(found.weight_sum));
}

DepthEvidence SurfaceFit::evidence_at(const Se3& camera_from_object) const {
  return evidence_of(compared(camera_from_object, JUDGEMENT_BAND, PoseDepthOptions{}.loss_scale));
}

}  // namespace edgescout
