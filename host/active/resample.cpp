// Resampling of the particles (modes.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/active/modes.h"
#include "host/active/weigh_particles.h"
#include "kernels/mutual_information.h"

namespace edgescout {

namespace {

// Systematic resampling: `count` draws in proportion to the weights, all from one random number.
// Returns how often each is drawn.
std::vector<int> systematic(std::span<const double> weights, int count, Random& random) {
  double total = 0;
  for (const double w : weights) total += w;
  std::vector<int> times(weights.size(), 0);
  const double offset = random.uniform();
  double reached = 0;
  int drawn = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    reached += weights[i] / total * count;
    while (drawn < count && offset + drawn < reached) ++drawn, ++times[i];
  }
  // Draws that rounding left over go to the last one that has a weight.
  for (std::size_t i = weights.size(); drawn < count && i-- > 0;)
    if (weights[i] > 0) times[i] += count - drawn, drawn = count;
  return times;
}

// Modes that keep particles because they are probable or heavy enough, heaviest first as given. All
// modes where none is.
std::vector<const Mode*> kept_modes(std::span<const Mode> modes, int count,
                                    const ParticleOptions& options) {
  std::vector<const Mode*> kept, all;
  for (const Mode& mode : modes) {
    all.push_back(&mode);
    if (mode.probability >= options.min_mode_probability || mode.weight * count >= 1)
      kept.push_back(&mode);
  }
  if (kept.empty()) kept = all;
  if (int(kept.size()) > count) kept.resize(count);
  return kept;
}

// Weights of a mode's particles relative to its heaviest; absolute ones could all underflow to 0.
std::vector<double> weights_within(const Mode& mode, std::span<const Particle> particles) {
  double most = -std::numeric_limits<double>::infinity();
  for (const std::size_t i : mode.particles) most = std::max(most, particles[i].log_weight);
  std::vector<double> weights;
  for (const std::size_t i : mode.particles)
    weights.push_back(std::exp(particles[i].log_weight - most));
  return weights;
}

// The number of particles of each mode.
std::vector<int> quotas(std::span<const Mode* const> modes, int count,
                        const ParticleOptions& options, Random& random) {
  const int least = std::min<int>(options.min_per_mode, count / int(modes.size()));
  std::vector<double> weights;
  for (const Mode* mode : modes) weights.push_back(mode->weight);
  std::vector<int> quota = systematic(weights, count - least * int(modes.size()), random);
  for (int& q : quota) q += least;
  return quota;
}

}  // namespace

std::vector<Particle> resample(std::span<const Particle> particles, std::span<const Mode> modes,
                               std::span<const EdgeModel> models, int count,
                               const ParticleOptions& options, Random random) {
  std::vector<Particle> next;
  if (modes.empty()) return next;
  const std::vector<const Mode*> kept = kept_modes(modes, count, options);
  const std::vector<int> quota = quotas(kept, count, options, random);
  // log_weight is normalised; resampled_px2 also keeps the constant, so that particles that are
  // drawn later, with a resampled_px2 of 0, get the right share of the weight.
  const Particle& any = particles[modes[0].particles[0]];
  const double log_norm =
      (any.resampled_px2 - any.upsilon_px2) / options.scale_px2() - any.log_weight;
  double total = 0;  // of the modes that keep particles
  for (std::size_t m = 0; m < kept.size(); ++m)
    if (quota[m] > 0) total += kept[m]->weight;
  for (std::size_t m = 0; m < kept.size(); ++m) {
    const Mode& mode = *kept[m];
    const std::vector<int> times = systematic(weights_within(mode, particles), quota[m], random);
    for (std::size_t k = 0; k < times.size(); ++k)
      for (int copy = 0; copy < times[k]; ++copy) {
        Particle particle = particles[mode.particles[k]];
        if (copy > 0)
          particle.world_from_object =
              perturbed(particle.world_from_object, particle.covariance, models[particle.object],
                        options.roughened, random);
        particle.log_weight = std::log(mode.weight / total / quota[m]);
        particle.resampled_px2 =
            particle.upsilon_px2 +
            options.scale_px2() * (std::log(mode.weight / quota[m]) + log_norm);
        next.push_back(std::move(particle));
      }
  }
  return next;
}

bool resample_where_poor(std::vector<Particle>& particles, std::span<const Mode> modes,
                         std::span<const EdgeModel> models, std::size_t images,
                         const ParticleOptions& options) {
  if (effective_sample_size(particles) >= options.min_effective * double(particles.size()) &&
      particles.size() <= INFORMATION_MAX_PARTICLES)
    return false;
  particles = resample(particles, modes, models, options.count, options,
                       Random(options.seed).split("particles").split(images).split("resample"));
  return true;
}

}  // namespace edgescout
