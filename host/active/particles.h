// The belief about where objects are: weighted poses ("particles") of all object types (paper,
// Sec. 5.3 and Algorithm 2, lines 11 and 15-19). A particle is one pose one object may have; what
// it weighs says weigh_particles.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/core/random.h"
#include "host/core/types.h"
#include "host/detect/plausible_pairs.h"
#include "host/model/template_set.h"
#include "host/register/d2co.h"
#include "host/register/edge_icp.h"
#include "host/register/pose_features.h"

namespace edgescout {

struct Particle {
  int object = 0;
  Se3 world_from_object;
  Matrix6d covariance = Matrix6d::Zero();  // of the last refinement, or of the candidate it was
                                           // drawn around; tangent of core/se3.h
  double log_weight = 0;                   // natural; weigh_particles makes the weights sum to 1
  double upsilon_px2 =
      0;  // log_weight is resampled_px2 - upsilon_px2, over s, up to a constant common to all
  double resampled_px2 = 0;
  // Where it was weighed, one a real view, and so is upsilon_px2: what resampling has moved since
  // keeps them. Empty until weighed.
  std::vector<PoseFeatures> by_view;
};

// How far drawn poses lie from where they were drawn around: a Gaussian of the covariance, its
// standard deviations (rotations times half the diameter) clamped to these fractions of the
// diameter. The lower bound keeps particles of one place apart, the upper one holds them where
// nothing is known.
struct Spread {
  double min = 0.005;
  double max = 0.1;
};

struct ParticleOptions {
  // Drawn at first, and whenever they are resampled. Between the two each search adds a share for
  // the candidates that are new: more are followed then, by half or so. At most
  // INFORMATION_MAX_PARTICLES (kernels/mutual_information.h).
  int count = 200;
  std::uint64_t seed = 1;
  double sigma_px = 4;            // of the mean DCD of a right pose, image px
  Spread drawn{0.02, 0.1};        // around candidates
  Spread roughened{0.003, 0.02};  // after resampling
  double min_effective =
      0.5;               // of the particles: with a lower effective sample size they are resampled
  int min_per_mode = 4;  // particles kept for every mode that may be an instance
  double min_mode_probability = 0.05;  // below it a mode lives by its weight alone
  double mode_radius =
      0.1;  // of the diameter: particles closer than that (modulo symmetry) are one mode
  double penetration_m =
      DEFAULT_PENETRATION_M;  // modes that reach further into each other exclude each other
  double dead_px = 20;        // mean DCD above which a particle is no hypothesis any more
  double min_points = 12;     // in an image, for it to say something about a particle
  D2coOptions d2co = refine_defaults();
  bool use_edge_icp = true;
  EdgeIcpOptions edge_icp_options = edge_icp_defaults();
  PoseScoreOptions score{1.0f, 4.0f, 60.0f};
  VisibilityOptions
      visibility;  // of the points that are scored; probabilities are fitted with the finest
  static D2coOptions refine_defaults();
  static EdgeIcpOptions edge_icp_defaults();
  double scale_px2() const { return 2 * sigma_px * sigma_px; }
  void validate() const;  // throws InputError naming the field and the violated bound
};

// A candidate of one view, found in its camera frame, carried to the world with its covariance.
Detection candidate_in_world(const Detection& in_camera, const Se3& camera_from_world);

// `count` particles, as many around each candidate, the first of each exactly there; with more
// candidates than particles those with the highest psi. Equal weights. None where there is no
// candidate.
std::vector<Particle> draw_particles(std::span<const EdgeModel> models,
                                     std::span<const Detection> candidates, int count,
                                     const Spread& spread, Random random);

// A pose near another, from a Gaussian in its tangent, turned about the middle of the model
// wherever its origin lies.
Se3 perturbed(const Se3& pose, const Matrix6d& covariance, const EdgeModel& model,
              const Spread& spread, Random& random);

std::vector<ObjectPose> poses_of(std::span<const Particle> particles);
std::vector<ObjectPose> poses_of(std::span<const Detection> candidates);

// Multi-view D2CO (Eq. 11) of all particles over all real views side by side: poses and
// covariances.
void refine_particles(std::span<const EdgeModel> models, std::span<Particle> particles,
                      std::span<const RegisterView> views, Backend& backend,
                      const ParticleOptions& options);

// What one real image did to the particles.
struct ParticleUpdate {
  double effective = 0;    // sample size before resampling
  bool reseeded = false;   // all had died and were drawn anew around the candidates
  double gained_nats = 0;  // from it, before resampling
};

// Lines 15-17 of Algorithm 2, after the last of `views` was added: refine and weigh. Where every
// particle died they are drawn anew around the candidates, once; a warning is logged, and another
// where these die too. Deterministic from options.seed and the number of views.
ParticleUpdate update_particles(std::vector<Particle>& particles, std::vector<double>& unseen_px2,
                                std::span<const EdgeModel> models,
                                std::span<const Detection> candidates,
                                std::span<const RegisterView> views, Backend& backend,
                                const ParticleOptions& options);

}  // namespace edgescout
