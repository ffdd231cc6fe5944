// What real images say about particles (paper, Eq. 18 and Algorithm 2, line 16).
//
// A particle's weight follows Bayes' rule on real images alone: w ~ exp(-Upsilon / s), Upsilon the
// sum over the real views of the squared mean DCD at the particle's pose (Eq. 18), s = 2
// sigma_px^2. Poses move when they are refined on a new image, so Upsilon is always that of all
// real views at the pose of today; what resampling has turned from weight into number of particles
// is remembered in `resampled_px2` and leaves the weight: no view counts twice. A particle drawn
// later starts with nothing spent and is weighed by all views like the others.
//
// A view that does not see a particle tells nothing about it. It counts for it like the view's mean
// likelihood over the particles it does see, as far as they were believed in before it: then the
// particle's share is after the view what it was before. That mean is decided when a view sees the
// first particles
// (`unseen_px2`), and the same for those that are drawn later.
#pragma once

#include <span>
#include <vector>

#include "host/active/particles.h"

namespace edgescout {

struct Weighing {
  std::size_t living = 0;
  // What the last of the views taught: the Kullback-Leibler divergence of the weights with it from
  // those without it, at the poses of today. 0 where it says the same of all particles. The
  // information expected of a view (kernels/mutual_information.h) is the expectation of such a
  // divergence, but for gamma.
  double gained_nats = 0;
};

// Features in every real view, Upsilon and normalised weights. A particle that is dead (no view
// sees it, mean DCD above dead_px, pose not finite) has weight 0 (log weight -infinity); where none
// lives, all weights are equal and nothing was gained. `unseen_px2` has one entry for each of the
// views so far, which are given in the same order every time, and grows with them: what a view adds
// to Upsilon of particles it does not see; not a number while it has seen none at all.
Weighing weigh_particles(std::span<const EdgeModel> models, std::span<Particle> particles,
                         std::vector<double>& unseen_px2, std::span<const RegisterView> views,
                         Backend& backend, const ParticleOptions& options);

// 1 / sum w^2, between 1 and the number of particles; 0 without particles. Weights need not be
// normalised.
double effective_sample_size(std::span<const Particle> particles);

}  // namespace edgescout
