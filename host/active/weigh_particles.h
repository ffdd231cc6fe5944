// Weighs particles by real images (paper, Eq. 18 and Algorithm 2, line 16).
//
// A particle's weight follows Bayes' rule on real images alone: w ~ exp(-Upsilon / s). Upsilon is
// the sum over the real views of the squared mean DCD at the particle's pose (Eq. 18), s = 2
// sigma_px^2. Poses move when they are refined on a new image, so Upsilon is always computed for
// all real views at the current pose. Resampling turns weight into a number of particles;
// `resampled_px2` keeps how much, and this part leaves the weight: no view counts twice. A particle
// that is drawn later starts with a resampled_px2 of 0 and is weighed by all views like the others.
//
// A view that does not see a particle gives no information about it. It counts like the view's mean
// likelihood over the particles that it does see, weighted by their weights before the view: then
// the particle's share of the weight does not change. That mean is fixed when a view sees its first
// particles (`unseen_px2`), and is the same for particles that are drawn later.
#pragma once

#include <span>
#include <vector>

#include "host/active/particles.h"

namespace edgescout {

struct Weighing {
  std::size_t living = 0;  // particles with a weight
  // Information from the last view: the Kullback-Leibler divergence of the weights with it from the
  // weights without it, at the current poses. 0 where the view changes all weights alike. The
  // information expected of a view (kernels/mutual_information.h) is the expectation of such a
  // divergence, but for gamma.
  double gained_nats = 0;
};

// Sets features in every view of the scene, Upsilon and normalised weights. A particle loses its
// weight (log weight -infinity) where no view sees it, where its mean DCD is above dead_px, where
// measured depth contradicts it, or where its pose is not finite. Where no particle is left, all
// weights are equal and the gain is 0.
//
// `unseen_px2` has one entry per view so far: what the view adds to Upsilon of particles that it
// does not see, NaN while it has seen none at all. It grows with the views, which must be given in
// the same order every time. LogicError: no view.
Weighing weigh_particles(const Scene& scene, std::span<Particle> particles,
                         std::vector<double>& unseen_px2, const ParticleOptions& options);

// 1 / sum w^2, between 1 and the number of particles; 0 without particles. Weights need not be
// normalised.
double effective_sample_size(std::span<const Particle> particles);

}  // namespace edgescout
