#include "host/active/weigh_particles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/error.h"

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

// To a sum of 1; equal where all are nothing.
void normalise(std::span<double> logs) {
  const double total = log_sum_exp(logs);
  for (double& x : logs) x = total == NOTHING ? -std::log(double(logs.size())) : x - total;
}

double squared(double x) { return x * x; }

bool sees(const PoseFeatures& in_view, const ParticleOptions& options) {
  return in_view.points >= options.min_points;
}

bool seen_at_all(const Particle& particle, const ParticleOptions& options) {
  return is_finite(particle.world_from_object) &&
         std::ranges::any_of(particle.by_view,
                             [&](const PoseFeatures& f) { return sees(f, options); });
}

bool lives(const Particle& particle, const ParticleOptions& options) {
  return seen_at_all(particle, options) &&
         pool_over_views(particle.by_view).mean_px <= options.dead_px;
}

// At the poses of today.
void look_at(std::span<const EdgeModel> models, std::span<Particle> particles,
             std::span<const RegisterView> views, Backend& backend,
             const ParticleOptions& options) {
  const std::vector<PoseFeatures> features = pose_features_by_view(
      models, poses_of(particles), views, backend, options.score, options.visibility);
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles[i].by_view.assign(features.begin() + i * views.size(),
                                features.begin() + (i + 1) * views.size());
}

// -s log of a view's mean likelihood over the particles that it sees, by the belief before it; not
// a number where it sees none.
double mean_likelihood_px2(std::span<const Particle> particles, std::span<const double> log_before,
                           std::size_t view, const ParticleOptions& options) {
  std::vector<double> before, after;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const PoseFeatures& f = particles[i].by_view[view];
    if (log_before[i] == NOTHING || !sees(f, options)) continue;
    before.push_back(log_before[i]);
    after.push_back(log_before[i] - squared(f.mean_px) / options.scale_px2());
  }
  return before.empty() ? std::nan("")
                        : options.scale_px2() * (log_sum_exp(before) - log_sum_exp(after));
}

// Adds one view's say to Upsilon and to the weights.
void add_view(std::size_t view, double& unseen_px2, std::span<Particle> particles,
              std::span<double> log_weights, const ParticleOptions& options) {
  if (std::isnan(unseen_px2))
    unseen_px2 = mean_likelihood_px2(particles, log_weights, view, options);
  const double unseen = std::isnan(unseen_px2) ? 0 : unseen_px2;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const PoseFeatures& f = particles[i].by_view[view];
    const double counts = sees(f, options) ? squared(f.mean_px) : unseen;
    particles[i].upsilon_px2 += counts;
    log_weights[i] -= counts / options.scale_px2();
  }
}

// Kullback-Leibler, of normalised weights.
double divergence_nats(std::span<const double> after, std::span<const double> before) {
  double nats = 0;
  for (std::size_t i = 0; i < after.size(); ++i)
    if (after[i] > NOTHING) nats += std::exp(after[i]) * (after[i] - before[i]);
  return std::max(0.0, nats);  // rounding can take it below
}

}  // namespace

Weighing weigh_particles(std::span<const EdgeModel> models, std::span<Particle> particles,
                         std::vector<double>& unseen_px2, std::span<const RegisterView> views,
                         Backend& backend, const ParticleOptions& options) {
  check(!views.empty(), "weigh_particles: at least one view");
  look_at(models, particles, views, backend, options);
  std::vector<double> logs, before_last;
  for (Particle& particle : particles) {
    particle.upsilon_px2 = 0;
    logs.push_back(seen_at_all(particle, options) ? particle.resampled_px2 / options.scale_px2()
                                                  : NOTHING);
  }
  unseen_px2.resize(views.size(), std::nan(""));
  for (std::size_t v = 0; v < views.size(); ++v) {
    before_last = logs;
    add_view(v, unseen_px2[v], particles, logs, options);
  }
  Weighing weighing;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (lives(particles[i], options))
      ++weighing.living;
    else
      logs[i] = NOTHING;
  normalise(before_last), normalise(logs);
  for (std::size_t i = 0; i < particles.size(); ++i) particles[i].log_weight = logs[i];
  if (weighing.living > 0) weighing.gained_nats = divergence_nats(logs, before_last);
  return weighing;
}

double effective_sample_size(std::span<const Particle> particles) {
  std::vector<double> logs, squares;
  for (const Particle& particle : particles)
    logs.push_back(particle.log_weight), squares.push_back(2 * particle.log_weight);
  const double total = log_sum_exp(logs);
  return total == NOTHING ? 0 : std::exp(2 * total - log_sum_exp(squares));
}

}  // namespace edgescout
