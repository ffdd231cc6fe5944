#include "host/active/particles.h"

#include <algorithm>
#include <cmath>

#include "host/active/weigh_particles.h"
#include "host/core/log.h"
#include "host/core/matrix6.h"
#include "host/core/order.h"
#include "host/register/d2co.h"
#include "host/register/edge_icp.h"
#include "kernels/mutual_information.h"

namespace edgescout {

namespace {

// Indices of the candidates with the highest psi, at most this many.
std::vector<std::size_t> best_candidates(std::span<const Detection> candidates, int most) {
  std::vector<double> psi;
  for (const Detection& candidate : candidates) psi.push_back(candidate.psi);
  std::vector<std::size_t> order = largest_first(psi);
  if (int(order.size()) > most) order.resize(most);
  return order;
}

}  // namespace

void describe(ParticleOptions& o, OptionVisitor& visit) {
  visit.group("Belief");
  visit.number({"penetration",
                "Largest depth to which parts may overlap, m. Parts that overlap further are in no "
                "combination together, and the less probable one loses probability"},
               o.penetration_m, 0.0, 1.0);
  visit.number(
      {"particles", "Number of pose particles. New candidates add to it until the next resampling"},
      o.count, 1, int(INFORMATION_MAX_PARTICLES));
}

void ParticleOptions::validate() const {
  check_bounds(*this, "scout");
  const BoundsCheck in("particles");
  in.require("sigma", sigma_px, 1e-3, 1e3);
  in.require("drawn_max", drawn.max, 0, 1);
  in.require("drawn_min", drawn.min, 0, drawn.max);
  in.require("drawn_of_deviation", drawn.of_deviation, 0, 10);
  in.require("roughened_max", roughened.max, 0, 1);
  in.require("roughened_min", roughened.min, 0, roughened.max);
  in.require("roughened_of_deviation", roughened.of_deviation, 0, 10);
  in.require("min_effective", min_effective, 0, 1);
  in.require("min_per_mode", min_per_mode, 0, 1e5);
  in.require("min_mode_probability", min_mode_probability, 0, 1);
  in.require("mode_radius", mode_radius, 1e-6, 10);
  in.require("dead", dead_px, 1e-3, 1e3);
  in.require("min_points", min_points, 1, 1e5);
  d2co.validate();
  edge_icp.validate();
  visibility.validate();
}

Detection candidate_in_world(const Detection& in_camera, const Se3& camera_from_world) {
  const Se3 world_from_camera = inverse(camera_from_world);
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() =
      world_from_camera.rotation.toRotationMatrix();
  Detection in_world = in_camera;
  in_world.world_from_object = world_from_camera * in_camera.world_from_object;
  if (in_camera.covariance.allFinite())
    in_world.covariance = turn * in_camera.covariance * turn.transpose();
  for (AlternativePose& pose : in_world.alternatives)
    pose.world_from_object = world_from_camera * pose.world_from_object;
  return in_world;
}

Se3 perturbed(const Se3& pose, const Matrix6d& covariance, const EdgeModel& model,
              const Spread& spread, Random& random) {
  const double diameter_m = model.mesh.diameter_m;
  // Rotations count as the motion of a point at half the diameter: then all six are in metres.
  Vector6d metres = Vector6d::Ones();
  metres.tail<3>().setConstant(0.5 * diameter_m);
  Vector6d deviations = Vector6d::Constant(spread.max * diameter_m);
  Matrix6d axes = Matrix6d::Identity();
  if (covariance.allFinite()) {
    const Eigenvectors6 principal =
        eigenvectors(metres.asDiagonal() * covariance_about(pose, model.center_m, covariance) *
                     metres.asDiagonal());
    axes = principal.vectors;
    deviations = (spread.of_deviation * principal.values.cwiseMax(0).cwiseSqrt())
                     .cwiseMax(spread.min * diameter_m)
                     .cwiseMin(spread.max * diameter_m);
  }
  Vector6d step;
  for (int i = 0; i < 6; ++i) step[i] = deviations[i] * random.normal();
  step = (axes * step).cwiseQuotient(metres);
  return retract_about(pose, model.center_m, step);
}

std::vector<Particle> draw_particles(std::span<const EdgeModel> models,
                                     std::span<const Detection> candidates, int count,
                                     const Spread& spread, Random random) {
  std::vector<Particle> particles;
  const std::vector<std::size_t> chosen = best_candidates(candidates, count);
  for (int i = 0; !chosen.empty() && i < count; ++i) {
    const Detection& candidate = candidates[chosen[i % chosen.size()]];
    Particle particle;
    particle.object = candidate.object;
    particle.covariance = candidate.covariance;
    particle.world_from_object = candidate.world_from_object;
    if (i >= int(chosen.size()))
      particle.world_from_object = perturbed(candidate.world_from_object, candidate.covariance,
                                             models[candidate.object], spread, random);
    particle.log_weight = -std::log(double(count));
    particles.push_back(std::move(particle));
  }
  return particles;
}

void refine_particles(const Scene& scene, std::span<Particle> particles,
                      const ParticleOptions& options) {
  std::vector<PoseEstimate> estimates =
      register_poses(scene, object_poses(particles), options.d2co);
  if (options.use_edge_icp) edge_icp(scene, estimates, options.edge_icp);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles[i].world_from_object = estimates[i].world_from_object;
    particles[i].covariance = estimates[i].covariance;
  }
}

ParticleUpdate update_particles(const Scene& scene, std::vector<Particle>& particles,
                                std::vector<double>& unseen_px2,
                                std::span<const Detection> candidates,
                                const ParticleOptions& options) {
  options.validate();
  const Random random = Random(options.seed).split("particles").split(scene.views.size());
  ParticleUpdate update;
  const auto refine_and_weigh = [&] {
    refine_particles(scene, particles, options);
    const Weighing weighing = weigh_particles(scene, particles, unseen_px2, options);
    update.gained_nats = weighing.gained_nats;
    return weighing.living;
  };
  if (refine_and_weigh() == 0 && !particles.empty()) {
    const std::string all_died =
        "all particles died in image " + std::to_string(scene.views.size());
    if (candidates.empty()) {
      log(LogLevel::Warning, all_died + ", and there is no candidate to draw others around");
    } else {
      log(LogLevel::Warning,
          all_died + "; drawn anew around " + std::to_string(candidates.size()) + " candidates");
      Spread wider = options.drawn;
      wider.max *= 2;
      particles =
          draw_particles(scene.models, candidates, options.count, wider, random.split("anew"));
      unseen_px2.clear();
      if (refine_and_weigh() == 0) log(LogLevel::Warning, all_died + ", those drawn anew too");
      update.reseeded = true;
    }
  }
  update.effective = effective_sample_size(particles);
  return update;
}

}  // namespace edgescout
