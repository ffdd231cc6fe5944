#include "host/active/particles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "host/active/modes.h"
#include "host/core/log.h"
#include "host/core/option_bounds.h"
#include "host/core/order.h"
#include "kernels/error.h"
#include "kernels/mutual_information.h"

namespace edgescout {

namespace {

constexpr double NOTHING = -std::numeric_limits<double>::infinity();

double log_sum_exp(std::span<const double> logs) {
  const double most = logs.empty() ? NOTHING : *std::ranges::max_element(logs);
  if (most == NOTHING) return NOTHING;
  double sum = 0;
  for (const double x : logs) sum += std::exp(x - most);
  return most + std::log(sum);
}

std::vector<Hypothesis> poses_of(std::span<const Particle> particles) {
  std::vector<Hypothesis> poses;
  for (const Particle& particle : particles) poses.push_back({particle.object, particle.world_from_object});
  return poses;
}

bool lives(const Particle& particle, const ParticleOptions& options) {
  const bool seen = std::ranges::any_of(
      particle.by_view, [&](const PoseFeatures& f) { return f.points >= options.min_points; });
  return seen && is_finite(particle.world_from_object) &&
         together(particle.by_view).mean_px <= options.dead_px;
}

// What a view counts for a particle that it does not see: -s log of its mean likelihood over those it does.
double unseen_px2(std::span<const Particle> particles, std::span<const char> living, std::size_t view,
                  const ParticleOptions& options) {
  std::vector<double> logs;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const PoseFeatures& f = particles[i].by_view[view];
    if (living[i] && f.points >= options.min_points)
      logs.push_back(-f.mean_px * f.mean_px / options.scale_px2());
  }
  return logs.empty() ? 0 : -options.scale_px2() * (log_sum_exp(logs) - std::log(double(logs.size())));
}

void normalise(std::span<Particle> particles) {
  std::vector<double> logs;
  for (const Particle& particle : particles) logs.push_back(particle.log_weight);
  const double total = log_sum_exp(logs);
  for (Particle& particle : particles)
    particle.log_weight =
        total == NOTHING ? -std::log(double(particles.size())) : particle.log_weight - total;
}

// The candidates by psi, as many as there may be particles.
std::vector<std::size_t> best_candidates(std::span<const Detection> candidates, int most) {
  std::vector<double> psi;
  for (const Detection& candidate : candidates) psi.push_back(candidate.psi);
  std::vector<std::size_t> order = largest_first(psi);
  if (int(order.size()) > most) order.resize(most);
  return order;
}

}  // namespace

D2coOptions ParticleOptions::refine_defaults() {
  D2coOptions options;
  options.rounds = {
      {LOSS_GEMAN_MCCLURE, 12, 8, 250}, {LOSS_GEMAN_MCCLURE, 5, 8, 300}, {LOSS_GEMAN_MCCLURE, 2, 6, 400}};
  options.visibility.depth_map_size_px = 96;
  return options;
}

// Several views see every particle: some of their points place it well enough.
PolishOptions ParticleOptions::polish_defaults() {
  PolishOptions options;
  options.max_points = 200;
  options.visibility.depth_map_size_px = 96;
  return options;
}

void ParticleOptions::validate() const {
  const OptionBounds in("particles");
  in("count", count, 1, INFORMATION_MAX_PARTICLES);
  in("sigma", sigma_px, 1e-3, 1e3);
  in("drawn_max", drawn.max, 0, 1);
  in("drawn_min", drawn.min, 0, drawn.max);
  in("roughened_max", roughened.max, 0, 1);
  in("roughened_min", roughened.min, 0, roughened.max);
  in("min_effective", min_effective, 0, 1);
  in("min_per_mode", min_per_mode, 0, 1e5);
  in("min_mode_probability", min_mode_probability, 0, 1);
  in("mode_radius", mode_radius, 1e-6, 10);
  in("penetration", penetration_m, 0, 1);
  in("dead", dead_px, 1e-3, 1e3);
  in("min_points", min_points, 1, 1e5);
  d2co.validate();
  polish_options.validate();
}

Detection candidate_in_world(const Detection& in_camera, const Se3& camera_from_world) {
  const Se3 world_from_camera = inverse(camera_from_world);
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = world_from_camera.rotation.toRotationMatrix();
  Detection in_world = in_camera;
  in_world.world_from_object = world_from_camera * in_camera.world_from_object;
  if (in_camera.covariance.allFinite()) in_world.covariance = turn * in_camera.covariance * turn.transpose();
  return in_world;
}

Se3 perturbed(const Se3& pose, const Matrix6d& covariance, double diameter_m, const Spread& spread,
              Random& random) {
  // Rotations as the way they move a point at half the diameter: all six in metres.
  Vector6d metres = Vector6d::Ones();
  metres.tail<3>().setConstant(0.5 * diameter_m);
  Vector6d deviations = Vector6d::Constant(spread.max * diameter_m);
  Matrix6d axes = Matrix6d::Identity();
  if (covariance.allFinite()) {
    const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(metres.asDiagonal() * covariance *
                                                         metres.asDiagonal());
    axes = solver.eigenvectors();
    deviations = solver.eigenvalues()
                     .cwiseMax(0)
                     .cwiseSqrt()
                     .cwiseMax(spread.min * diameter_m)
                     .cwiseMin(spread.max * diameter_m);
  }
  Vector6d step;
  for (int i = 0; i < 6; ++i) step[i] = deviations[i] * random.normal();
  step = (axes * step).cwiseQuotient(metres);
  return retract(pose, step);
}

std::vector<Particle> draw_particles(std::span<const EdgeModel> models, std::span<const Detection> candidates,
                                     int count, const Spread& spread, Random random) {
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
                                             models[candidate.object].mesh.diameter_m, spread, random);
    particle.log_weight = -std::log(double(count));
    particles.push_back(std::move(particle));
  }
  return particles;
}

void refine_particles(std::span<const EdgeModel> models, std::span<Particle> particles,
                      std::span<const RegisterView> views, Backend& backend, const ParticleOptions& options) {
  const std::vector<Hypothesis> starts = poses_of(particles);
  std::vector<Registration> registrations = register_poses(models, starts, views, backend, options.d2co);
  if (options.polish) polish_poses(models, starts, views, backend, options.polish_options, registrations);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles[i].world_from_object = registrations[i].world_from_object;
    particles[i].covariance = registrations[i].covariance;
  }
}

std::size_t weigh_particles(std::span<const EdgeModel> models, std::span<Particle> particles,
                            std::span<const RegisterView> views, Backend& backend,
                            const ParticleOptions& options) {
  check(!views.empty(), "weigh_particles: at least one view");
  const std::vector<PoseFeatures> features =
      pose_features_by_view(models, poses_of(particles), views, backend, options.score, options.visibility);
  std::vector<char> living;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles[i].by_view.assign(features.begin() + i * views.size(),
                                features.begin() + (i + 1) * views.size());
    particles[i].upsilon_px2 = 0;
    living.push_back(lives(particles[i], options));
  }
  for (std::size_t v = 0; v < views.size(); ++v) {
    const double unseen = unseen_px2(particles, living, v, options);
    for (Particle& particle : particles) {
      const PoseFeatures& f = particle.by_view[v];
      particle.upsilon_px2 += f.points >= options.min_points ? f.mean_px * f.mean_px : unseen;
    }
  }
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles[i].log_weight =
        living[i] ? (particles[i].spent_px2 - particles[i].upsilon_px2) / options.scale_px2() : NOTHING;
  normalise(particles);
  return std::size_t(std::ranges::count(living, char(1)));
}

double effective_sample_size(std::span<const Particle> particles) {
  std::vector<double> logs, squares;
  for (const Particle& particle : particles)
    logs.push_back(particle.log_weight), squares.push_back(2 * particle.log_weight);
  const double total = log_sum_exp(logs);
  return total == NOTHING ? 0 : std::exp(2 * total - log_sum_exp(squares));
}

ParticleUpdate update_particles(std::vector<Particle>& particles, std::span<const TemplateSet> sets,
                                std::span<const EdgeModel> models, std::span<const Detection> candidates,
                                std::span<const RegisterView> views, Backend& backend,
                                const ParticleOptions& options) {
  options.validate();
  const Random random = Random(options.seed).split("particles").split(views.size());
  ParticleUpdate update;
  const auto refine_and_weigh = [&] {
    refine_particles(models, particles, views, backend, options);
    return weigh_particles(models, particles, views, backend, options);
  };
  if (refine_and_weigh() == 0 && !candidates.empty()) {
    log(LogLevel::Warning, "all particles died in image " + std::to_string(views.size()) +
                               "; drawn anew around " + std::to_string(candidates.size()) + " candidates");
    const Spread wider{options.drawn.min, 2 * options.drawn.max};
    particles = draw_particles(models, candidates, options.count, wider, random.split("anew"));
    refine_and_weigh();
    update.reseeded = true;
  }
  update.effective = effective_sample_size(particles);
  if (update.effective < options.min_effective * double(particles.size()) ||
      particles.size() > INFORMATION_MAX_PARTICLES) {
    particles = resample(particles, find_modes(particles, sets, models, options, backend.threads()), models,
                         options.count, options, random.split("resample"));
    update.resampled = true;
  }
  return update;
}

}  // namespace edgescout
