#include "host/register/depth_systems.h"

#include <algorithm>

#include "host/core/matrix6.h"
#include "host/register/measured_depth.h"

namespace edgescout {

namespace {

constexpr double LEAST_BAND_M = 1.5e-3;
constexpr double INDEPENDENT_SAMPLES = 25;

}  // namespace

WorldSystem world_system(const PoseDepth& depth, const Se3& camera_from_world, double loss_sigmas) {
  WorldSystem system, in_world;
  int entry = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b)
      system.hessian(a, b) = system.hessian(b, a) = double(depth.hessian[entry++]);
    system.gradient[a] = double(depth.gradient[a]);
  }
  // Hidden samples cost as much as a sample can: a pose must not gain by sinking into a surface.
  system.depth_cost = depth.cost + 0.5 * loss_sigmas * loss_sigmas * depth.hidden;
  system.depth_points = depth.agreeing + depth.contradicting + depth.hidden;
  add_view(in_world, system, camera_from_world);
  return in_world;
}

PoseDepthOptions pose_depth_options(const DepthNoise& noise, double diameter_m, double band) {
  PoseDepthOptions options;
  options.noise_floor_m = std::max(float(noise.floor_m), DEPTH_MIN_NOISE_M);
  options.noise_per_m = float(noise.at_one_metre_m);
  options.band_m = float(std::max(LEAST_BAND_M, band * diameter_m));
  return options;
}

PoseDepthOptions pose_depth_options(const Scene& scene, double band) {
  DepthNoise noise{0, 0};
  for (const ObjectView& view : scene.views)
    if (view.depth) {
      noise.floor_m = std::max(noise.floor_m, view.depth->noise.floor_m);
      noise.at_one_metre_m = std::max(noise.at_one_metre_m, view.depth->noise.at_one_metre_m);
    }
  double diameter_m = 0;
  for (const EdgeModel& model : scene.models)
    diameter_m = std::max(diameter_m, model.mesh.diameter_m);
  return pose_depth_options(noise, diameter_m, band);
}

double independent_share(double weight_sum) {
  return weight_sum > INDEPENDENT_SAMPLES ? INDEPENDENT_SAMPLES / weight_sum : 1;
}

void add_depth_information(Matrix6d& covariance, const Matrix6d& depth_hessian, double weight_sum) {
  if (!(weight_sum > 0) || !covariance.allFinite()) return;
  const Matrix6d information = inverse(covariance) + independent_share(weight_sum) * depth_hessian;
  const Matrix6d joined = inverse(information);
  if (joined.allFinite()) covariance = 0.5 * (joined + joined.transpose());
}

DepthSystems::DepthSystems(const Scene& scene, PointsInViews<SurfacePoint> surface,
                           double loss_sigmas)
    : scene_(scene), ranges_(std::move(surface.ranges)) {
  for (std::size_t v = 0; v < scene.views.size(); ++v)
    if (scene.views[v].depth_values) {
      views_.push_back(v);
      depths_.push_back(scene.views[v].depth_values);
    }
  options_ = pose_depth_options(scene, REGISTRATION_BAND);
  options_.loss_scale = float(loss_sigmas);
  points_ = scene.backend.make_surface_points(std::move(surface.points));
}

void DepthSystems::add_at_trials(std::span<const LmState> states,
                                 std::span<WorldSystem> systems) const {
  std::vector<PoseProblem> problems;
  std::vector<std::size_t> active;
  for (std::size_t p = 0; p < states.size(); ++p) {
    if (!states[p].active) continue;
    active.push_back(p);
    for (std::size_t k = 0; k < views_.size(); ++k) {
      const PointRange& range = ranges_(p, views_[k]);
      problems.push_back({to_pose(scene_.views[views_[k]].camera_from_world * states[p].trial),
                          range.first, range.count, std::uint32_t(k)});
    }
  }
  std::vector<PoseDepth> results(problems.size());
  scene_.backend.pose_depth(depths_, *points_, problems, options_, results);
  for (std::size_t i = 0; i < results.size(); ++i)
    systems[active[i / views_.size()]] +=
        world_system(results[i], scene_.views[views_[i % views_.size()]].camera_from_world,
                     double(options_.loss_scale));
}

}  // namespace edgescout
