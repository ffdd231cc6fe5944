// Particles: weighted poses of all objects that represent where instances may be (paper, Sec. 5.3
// and Algorithm 2, lines 11 and 15-19). A particle is one pose that one object may have;
// weigh_particles.h gives its weight.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/core/options.h"
#include "host/core/random.h"
#include "host/core/types.h"
#include "host/detect/plausible_pairs.h"
#include "host/model/template_set.h"
#include "host/register/pose_features.h"
#include "host/register/schedules.h"
#include "host/register/thresholds.h"

namespace edgescout {

struct Particle : ObjectPose {
  // Of the last refinement, or of the candidate that the particle was drawn around; tangent of
  // core/se3.h.
  Matrix6d covariance = Matrix6d::Zero();
  double log_weight = 0;  // natural; weigh_particles makes the weights sum to 1
  // log_weight is (resampled_px2 - upsilon_px2) / scale_px2, up to a constant common to all.
  double upsilon_px2 = 0;
  double resampled_px2 = 0;
  // At the pose where the particle was weighed, one entry per real view; empty until then.
  // upsilon_px2 is of that pose, too. Both stay when resampling moves the particle.
  std::vector<PoseFeatures> features;
};

// How far random poses lie from the pose they are drawn around: a Gaussian of the covariance. Its
// standard deviations (rotations times half the diameter), times `of_deviation`, are clamped to the
// other two, fractions of the diameter. The lower bound keeps particles of one place apart; the
// upper one keeps them near where the covariance is unknown.
struct Spread {
  double min = 0.005;
  double max = 0.1;
  double of_deviation = 1;
};

// A covariance covers the rare large errors (register/edge_covariance.h). Most poses lie much
// nearer, and particles stand for these.
inline constexpr double USUAL_DEVIATION = 0.2;

struct ParticleOptions {
  // Drawn at first, and whenever they are resampled. In between, each search adds a share for the
  // new candidates, by which the number grows by about half. At most INFORMATION_MAX_PARTICLES
  // (kernels/mutual_information.h).
  int count = 200;
  std::uint64_t seed = 1;
  double sigma_px = 4;                             // of the mean DCD of a right pose, image px
  Spread drawn{0.02, 0.1, USUAL_DEVIATION};        // around candidates
  Spread roughened{0.003, 0.02, USUAL_DEVIATION};  // after resampling
  // Fraction of the particles: with a lower effective sample size they are resampled.
  double min_effective = 0.5;
  int min_per_mode = 4;                // particles kept for every mode that may be an instance
  double min_mode_probability = 0.05;  // below it only a mode's weight keeps its particles
  // Fraction of the diameter: particles nearer than that (modulo symmetry) are one mode.
  double mode_radius = thresholds::SAME_POSE;
  double penetration_m = DEFAULT_PENETRATION_M;  // modes that overlap further exclude each other
  double dead_px = 20;                           // a particle of a larger mean DCD loses its weight
  double min_points = thresholds::MIN_POINTS;  // that an image must show of a particle to weigh it
  D2coOptions d2co = schedules::particles();
  bool use_edge_icp = true;
  EdgeIcpOptions edge_icp = schedules::particles_edge_icp();
  PoseScoreOptions score = FeatureOptions{}.score;
  // Of the points that are scored. The probabilities are fitted with the finest setting.
  VisibilityOptions visibility;
  double scale_px2() const { return 2 * sigma_px * sigma_px; }
  void validate() const;  // InputError naming the field and the violated bound
};

void describe(ParticleOptions& options, OptionVisitor& visit);

// Transforms a candidate of one view from its camera frame to the world, with its covariance and
// alternatives.
Detection candidate_in_world(const Detection& in_camera, const Se3& camera_from_world);

// `count` particles of equal weight, the same number around each candidate; the first of each is
// exactly there. With more candidates than particles only those with the highest psi get one. No
// candidate: no particle.
std::vector<Particle> draw_particles(std::span<const EdgeModel> models,
                                     std::span<const Detection> candidates, int count,
                                     const Spread& spread, Random random);

// A random pose near another, from a Gaussian in its tangent. Rotations turn it about the centre of
// the model, wherever the model's origin lies.
Se3 perturbed(const Se3& pose, const Matrix6d& covariance, const EdgeModel& model,
              const Spread& spread, Random& random);

// Multi-view D2CO (Eq. 11) of all particles over all views of the scene at once: sets poses and
// covariances.
void refine_particles(const Scene& scene, std::span<Particle> particles,
                      const ParticleOptions& options);

// How one real image changed the particles.
struct ParticleUpdate {
  double effective = 0;    // effective sample size before resampling
  bool reseeded = false;   // all had lost their weight and were drawn anew around the candidates
  double gained_nats = 0;  // information from the image, before resampling
};

// Lines 15-17 of Algorithm 2, after the last view of the scene was added: refines and weighs the
// particles. `unseen_px2` as for weigh_particles.
//
// Where every particle lost its weight, they are drawn anew around the candidates, once, and a
// warning is logged; another one where these lose it too. Deterministic from options.seed and the
// number of views. InputError: options out of bounds.
ParticleUpdate update_particles(const Scene& scene, std::vector<Particle>& particles,
                                std::vector<double>& unseen_px2,
                                std::span<const Detection> candidates,
                                const ParticleOptions& options);

}  // namespace edgescout
