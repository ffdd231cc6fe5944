// Modes of the belief: particles at one place, modulo the object's symmetry. Each is a hypothetical
// instance.
#pragma once

#include <span>
#include <vector>

#include "host/active/particles.h"
#include "host/detect/edge_claims.h"

namespace edgescout {

struct Mode {
  int object = 0;
  std::vector<std::size_t> particles;  // the best one, by evidence over all views, first
  double weight = 0;                   // sum of its particles', over that of all
  // Of the best particle, from all views (detect/probability_over_views.h), and where there are
  // several, that no more probable mode stands where it would reach into (exclusive_probabilities);
  // 0 before particles are weighed.
  double probability = 0;
};

// Heaviest first. Every particle of weight above 0 belongs to one mode.
std::vector<Mode> find_modes(std::span<const Particle> particles, std::span<const TemplateSet> sets,
                             std::span<const EdgeModel> models, const ParticleOptions& options,
                             ThreadPool& pool);

// Systematic resampling with a quota a mode, so that instances whose images fit less well (hidden
// in part, say) do not starve: modes that are probable or heavy enough keep at least min_per_mode,
// the rest is shared by weight. Within a mode particles are drawn by weight. Each mode's weight is
// what it was, shared evenly by its particles. Copies after the first of a particle are roughened
// with its covariance.
std::vector<Particle> resample(std::span<const Particle> particles, std::span<const Mode> modes,
                               std::span<const EdgeModel> models, int count,
                               const ParticleOptions& options, Random random);

// Lines 18 and 19 of Algorithm 2: resamples where the effective sample size is low or there are
// more particles than the kernels take. Whether it did. Deterministic from options.seed and the
// number of images.
bool resample_where_poor(std::vector<Particle>& particles, std::span<const Mode> modes,
                         std::span<const EdgeModel> models, std::size_t images,
                         const ParticleOptions& options);

// An instance the belief holds for real.
struct ModeDetection {
  Detection detection;  // of the mode's best particle; covariance: of its refinement plus the
                        // scatter of the mode's particles
  double weight = 0;    // of the mode
  // images so far, counted from 0, whose features alone make the pose probable
  std::vector<int> supporting_images;
};

struct ModeDetectionOptions {
  double min_probability = 0.25;      // of what is reported
  double support_probability = 0.03;  // three times the base rate: of the pose by one view's
                                      // features alone, for the view to support it
  EdgeClaimOptions edge_claims;       // modes that compete for the same edges: the likeliest stays
};

// Best probability first. `particles` must have been weighed with these views, and not been
// resampled since: what roughening scatters is no uncertainty.
std::vector<ModeDetection> mode_detections(std::span<const Particle> particles,
                                           std::span<const Mode> modes,
                                           std::span<const TemplateSet> sets,
                                           std::span<const EdgeModel> models,
                                           std::span<const RegisterView> views, Backend& backend,
                                           const ModeDetectionOptions& options = {});

// Those at least so probable: known well enough to hide others (register/occluders.h) and not to be
// sought again.
std::vector<ObjectPose> known_objects(std::span<const ModeDetection> detections,
                                      double least_probability);

// How undecided the belief is, nats: sum over modes of the entropy of "is an instance or not". Zero
// where every mode is certain to be or not to be one.
double belief_entropy(std::span<const Mode> modes);

}  // namespace edgescout
