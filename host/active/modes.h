// Modes of the particles: particles of one object at one place, modulo the object's symmetry. Each
// mode is a possible instance.
#pragma once

#include <span>
#include <vector>

#include "host/active/particles.h"
#include "host/detect/edge_claims.h"

namespace edgescout {

struct Mode {
  int object = 0;
  std::vector<std::size_t> particles;  // the best one, by psi_z_score over all views, first
  double weight = 0;                   // sum of its particles' weights, over that of all particles
  // Of the best particle, from all views (register/pose_classifier.h). With several views it is
  // multiplied by the probability that no more probable mode is where this one would collide with
  // it (exclusive_probabilities). 0 before particles are weighed.
  double probability = 0;
};

// Heaviest first. Every particle of weight above 0 belongs to one mode.
std::vector<Mode> find_modes(std::span<const Particle> particles, std::span<const TemplateSet> sets,
                             std::span<const EdgeModel> models, const ParticleOptions& options,
                             ThreadPool& pool);

// Systematic resampling with a quota per mode, so that instances whose images fit less well, for
// example partly hidden ones, keep their particles. Modes that are probable or heavy enough keep at
// least min_per_mode particles; the rest is shared by weight. Within a mode particles are drawn by
// weight. A mode's weight stays what it was and is shared evenly by its particles. Copies of a
// particle after the first are moved at random by its covariance (roughening).
std::vector<Particle> resample(std::span<const Particle> particles, std::span<const Mode> modes,
                               std::span<const EdgeModel> models, int count,
                               const ParticleOptions& options, Random random);

// Lines 18 and 19 of Algorithm 2: resamples where the effective sample size is low, or where there
// are more particles than the kernels take. Returns whether it did. Deterministic from options.seed
// and the number of images.
bool resample_where_poor(std::vector<Particle>& particles, std::span<const Mode> modes,
                         std::span<const EdgeModel> models, std::size_t images,
                         const ParticleOptions& options);

// A mode that is reported as an instance.
struct ModeDetection {
  // Of the mode's best particle. Its covariance is that of the refinement plus the scatter of the
  // mode's particles.
  Detection detection;
  double weight = 0;  // of the mode
  // Images, counted from 0, whose features alone make the pose probable.
  std::vector<int> supporting_images;
};

struct ModeDetectionOptions {
  double min_probability = 0.25;  // of what is reported
  // For a view to support a pose: probability by the features of this view alone. Three times the
  // base rate.
  double support_probability = 0.03;
  EdgeClaimOptions edge_claims;  // of modes that compete for the same edges the likeliest stays
};

void describe(ModeDetectionOptions& options, OptionVisitor& visit);

// Most probable first. `particles` must have been weighed with the scene's views and not been
// resampled since, because roughening is no uncertainty. LogicError: weighed with another number of
// views.
std::vector<ModeDetection> mode_detections(const Scene& scene, std::span<const TemplateSet> sets,
                                           std::span<const Particle> particles,
                                           std::span<const Mode> modes,
                                           const ModeDetectionOptions& options = {});

// Poses of the detections with at least this probability. They are known well enough to act as
// occluders (register/occluders.h), and later searches skip them.
std::vector<ObjectPose> known_objects(std::span<const ModeDetection> detections,
                                      double min_probability);

// Entropy of the modes, nats: sum over the modes of the entropy of "is an instance or not". 0 where
// every mode is certain to be an instance or certain to be none.
double belief_entropy(std::span<const Mode> modes);

}  // namespace edgescout
