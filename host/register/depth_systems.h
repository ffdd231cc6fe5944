// What measured depth adds to the systems of a registration (kernels/pose_depth.h).
#pragma once

#include <span>
#include <vector>

#include "host/core/depth_image.h"
#include "host/register/lm_state.h"
#include "host/register/points_in_views.h"
#include "host/register/scene.h"

namespace edgescout {

// One standard deviation of a sample's distance counts as one pixel of an edge point's.
class DepthSystems {
 public:
  // `loss_sigmas`: scale of the loss, standard deviations. Views without depth take no part; there
  // must be one with depth (Scene::has_depth).
  DepthSystems(const Scene& scene, PointsInViews<SurfacePoint> surface, double loss_sigmas);

  // Adds to the systems of the active states those at their trial poses. States and systems are in
  // the order of the poses.
  void add_at_trials(std::span<const LmState> states, std::span<WorldSystem> systems) const;

 private:
  const Scene& scene_;
  std::vector<std::size_t> views_;  // those with depth
  std::vector<DepthHandle> depths_;
  Grid<PointRange> ranges_;  // rows are poses, columns all views
  SurfacePointsHandle points_;
  PoseDepthOptions options_;
};

// The system of one view in the world's tangent, as LmState takes it.
WorldSystem world_system(const PoseDepth& in_camera, const Se3& camera_from_world,
                         double loss_sigmas = PoseDepthOptions{}.loss_scale);

// Within which part of the object's diameter a surface is the pose's own. Registration also pulls
// poses whose surface would count as hidden when they are judged.
inline constexpr double REGISTRATION_BAND = 0.1, JUDGEMENT_BAND = 0.04;

PoseDepthOptions pose_depth_options(const DepthNoise& noise, double diameter_m, double band);
// The options for the noise of the scene's depth and a band of the size of its largest object.
PoseDepthOptions pose_depth_options(const Scene& scene, double band);

// The share of their information that samples with this sum of weights have: as much as 25
// independent samples at most, since the errors of neighbours depend on each other.
double independent_share(double weight_sum);

// Adds to a covariance by edges what measured depth informs, in the same tangent. Unchanged where
// nothing is measured, or edges do not determine the pose.
void add_depth_information(Matrix6d& covariance, const Matrix6d& depth_hessian, double weight_sum);

}  // namespace edgescout
