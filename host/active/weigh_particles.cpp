#include "host/active/weigh_particles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/register/depth_evidence.h"
#include "host/register/pose_classifier.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr double NO_WEIGHT = -std::numeric_limits<double>::infinity();

double log_sum_exp(std::span<const double> logs) {
  const double most = logs.empty() ? NO_WEIGHT : *std::ranges::max_element(logs);
  if (most == NO_WEIGHT) return NO_WEIGHT;
  double sum = 0;
  for (const double x : logs) sum += std::exp(x - most);
  return most + std::log(sum);
}

// To weights of sum 1; equal weights where none has a weight.
void normalise(std::span<double> logs) {
  const double total = log_sum_exp(logs);
  for (double& x : logs) x = total == NO_WEIGHT ? -std::log(double(logs.size())) : x - total;
}

double squared(double x) { return x * x; }

bool is_seen(const PoseFeatures& in_view, const ParticleOptions& options) {
  return in_view.points >= options.min_points;
}

bool is_seen_by_any(const Particle& particle, const ParticleOptions& options) {
  return is_finite(particle.world_from_object) &&
         std::ranges::any_of(particle.features,
                             [&](const PoseFeatures& f) { return is_seen(f, options); });
}

bool keeps_weight(const Particle& particle, const ParticleOptions& options) {
  if (!is_seen_by_any(particle, options)) return false;
  const PoseFeatures pooled = pool_over_views(particle.features);
  return pooled.mean_px <= options.dead_px && !is_contradicted(pooled.depth);
}

// At the current poses.
void measure_particles(const Scene& scene, std::span<Particle> particles,
                       const ParticleOptions& options) {
  const Grid<PoseFeatures> features =
      features_by_view(scene, object_poses(particles), {options.score, options.visibility});
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::span<const PoseFeatures> by_view = features.row(i);
    particles[i].features.assign(by_view.begin(), by_view.end());
  }
}

// -s log of a view's mean likelihood over the particles that it sees, weighted as before the view;
// NaN where it sees none.
double mean_likelihood_px2(std::span<const Particle> particles, std::span<const double> log_before,
                           std::size_t view, const ParticleOptions& options) {
  std::vector<double> before, after;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const PoseFeatures& f = particles[i].features[view];
    if (log_before[i] == NO_WEIGHT || !is_seen(f, options)) continue;
    before.push_back(log_before[i]);
    after.push_back(log_before[i] - squared(f.mean_px) / options.scale_px2());
  }
  return before.empty() ? std::nan("")
                        : options.scale_px2() * (log_sum_exp(before) - log_sum_exp(after));
}

// Adds one view to Upsilon and to the weights.
void add_view(std::size_t view, double& unseen_px2, std::span<Particle> particles,
              std::span<double> log_weights, const ParticleOptions& options) {
  if (std::isnan(unseen_px2))
    unseen_px2 = mean_likelihood_px2(particles, log_weights, view, options);
  const double unseen = std::isnan(unseen_px2) ? 0 : unseen_px2;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const PoseFeatures& f = particles[i].features[view];
    const double added_px2 = is_seen(f, options) ? squared(f.mean_px) : unseen;
    particles[i].upsilon_px2 += added_px2;
    log_weights[i] -= added_px2 / options.scale_px2();
  }
}

// Kullback-Leibler divergence of normalised weights.
double divergence_nats(std::span<const double> after, std::span<const double> before) {
  double nats = 0;
  for (std::size_t i = 0; i < after.size(); ++i)
    if (after[i] > NO_WEIGHT) nats += std::exp(after[i]) * (after[i] - before[i]);
  return std::max(0.0, nats);  // rounding can take it below
}

}  // namespace

Weighing weigh_particles(const Scene& scene, std::span<Particle> particles,
                         std::vector<double>& unseen_px2, const ParticleOptions& options) {
  const std::size_t views = scene.views.size();
  check(views > 0, "weigh_particles: at least one view");
  measure_particles(scene, particles, options);
  std::vector<double> logs, before_last;
  for (Particle& particle : particles) {
    particle.upsilon_px2 = 0;
    logs.push_back(is_seen_by_any(particle, options) ? particle.resampled_px2 / options.scale_px2()
                                                     : NO_WEIGHT);
  }
  unseen_px2.resize(views, std::nan(""));
  for (std::size_t v = 0; v < views; ++v) {
    before_last = logs;
    add_view(v, unseen_px2[v], particles, logs, options);
  }
  Weighing weighing;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (keeps_weight(particles[i], options))
      ++weighing.living;
    else
      logs[i] = NO_WEIGHT;
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
  return total == NO_WEIGHT ? 0 : std::exp(2 * total - log_sum_exp(squares));
}

}  // namespace edgescout
