#include "host/active/modes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/order.h"
#include "host/detect/detect.h"
#include "host/detect/distinct_poses.h"
#include "host/register/pose_classifier.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Above 0 for every particle that has a weight, even where exp underflows because sigma is small:
// its images may still make it probable.
double weight_of(const Particle& particle) {
  const bool has_weight = particle.log_weight > -std::numeric_limits<double>::infinity();
  return has_weight ? std::max(std::exp(particle.log_weight), std::numeric_limits<double>::min())
                    : 0;
}

// By psi_z_score where particles have been weighed, else by weight.
std::vector<std::size_t> best_first(std::span<const Particle> particles) {
  std::vector<double> score;
  for (const Particle& particle : particles)
    score.push_back(particle.features.empty() ? particle.log_weight
                                              : psi_z_score(pool_over_views(particle.features)));
  return largest_first(score);
}

// The symmetric equivalent of `pose` that lies nearest to `reference`.
Se3 nearest_equivalent(const Se3& pose, const Se3& reference, const TemplateSet& set) {
  Se3 nearest = pose;
  double least_m = pose_distance_m(reference, pose, set.model.mesh, Symmetries{});
  for (const Se3& symmetry : set.symmetries.discrete) {
    const double distance_m =
        pose_distance_m(reference, pose * symmetry, set.model.mesh, Symmetries{});
    if (distance_m < least_m) least_m = distance_m, nearest = pose * symmetry;
  }
  return nearest;
}

// Covariance of the mode's poses about the best one.
Matrix6d scatter(std::span<const Particle> particles, const Mode& mode, const TemplateSet& set) {
  const Se3& best = particles[mode.particles[0]].world_from_object;
  Matrix6d sum = Matrix6d::Zero();
  double total = 0;
  for (const std::size_t i : mode.particles) {
    const Vector6d offset =
        local_coordinates(best, nearest_equivalent(particles[i].world_from_object, best, set));
    sum += weight_of(particles[i]) * offset * offset.transpose();
    total += weight_of(particles[i]);
  }
  return total > 0 ? Matrix6d(sum / total) : sum;
}

PoseEstimate best_estimate(const Mode& mode, std::span<const Particle> particles) {
  const Particle& best = particles[mode.particles[0]];
  PoseEstimate estimate;
  estimate.object = best.object;
  estimate.world_from_object = best.world_from_object;
  estimate.covariance = best.covariance;
  estimate.features = best.features;
  classify(estimate);
  return estimate;
}

void set_probabilities(std::span<Mode> modes, std::span<const Particle> particles,
                       std::span<const EdgeModel> models, double penetration_m, ThreadPool& pool) {
  std::vector<PoseEstimate> estimates;
  for (const Mode& mode : modes) estimates.push_back(best_estimate(mode, particles));
  const std::vector<double> probabilities =
      probabilities_without_collisions(models, estimates, penetration_m, pool);
  for (std::size_t i = 0; i < modes.size(); ++i) modes[i].probability = probabilities[i];
}

ModeDetection to_mode_detection(const Mode& mode, const PoseEstimate& best,
                                double support_probability) {
  ModeDetection found{to_detection(best), mode.weight, {}};
  found.detection.probability = mode.probability;
  found.detection.convergence = "particle mode";
  for (std::size_t v = 0; v < best.features.size(); ++v)
    if (PoseClassifier::probability(best.features[v]) >= support_probability)
      found.supporting_images.push_back(int(v));
  return found;
}

}  // namespace

std::vector<Mode> find_modes(std::span<const Particle> particles, std::span<const TemplateSet> sets,
                             std::span<const EdgeModel> models, const ParticleOptions& options,
                             ThreadPool& pool) {
  std::vector<Mode> modes;
  double total = 0;
  for (const std::size_t i : best_first(particles)) {
    const Particle& particle = particles[i];
    if (!(weight_of(particle) > 0)) continue;
    total += weight_of(particle);
    const TemplateSet& set = sets[particle.object];
    const double radius_m = options.mode_radius * set.model.mesh.diameter_m;
    auto own = std::ranges::find_if(modes, [&](const Mode& mode) {
      return mode.object == particle.object &&
             pose_distance_m(particles[mode.particles[0]].world_from_object,
                             particle.world_from_object, set.model.mesh, set.symmetries) < radius_m;
    });
    if (own == modes.end()) own = modes.insert(own, {particle.object, {}, 0, 0});
    own->particles.push_back(i);
    own->weight += weight_of(particle);
  }
  for (Mode& mode : modes) mode.weight /= total;
  set_probabilities(modes, particles, models, options.penetration_m, pool);
  std::ranges::stable_sort(modes, [](const Mode& a, const Mode& b) { return a.weight > b.weight; });
  return modes;
}

std::vector<ModeDetection> mode_detections(const Scene& scene, std::span<const TemplateSet> sets,
                                           std::span<const Particle> particles,
                                           std::span<const Mode> modes,
                                           const ModeDetectionOptions& options) {
  std::vector<const Mode*> probable;
  std::vector<PoseEstimate> estimates;
  for (const Mode& mode : modes) {
    if (mode.probability < options.min_probability) continue;
    check(particles[mode.particles[0]].features.size() == scene.views.size(),
          "mode_detections: particles weighed with these views");
    probable.push_back(&mode);
    estimates.push_back(best_estimate(mode, particles));
  }
  std::vector<ModeDetection> found;
  for (const EdgeClaim& chosen : claim_edges(scene, estimates, options.edge_claims)) {
    const Mode& mode = *probable[chosen.index];
    found.push_back(to_mode_detection(mode, estimates[chosen.index], options.support_probability));
    found.back().detection.covariance += scatter(particles, mode, sets[mode.object]);
  }
  std::ranges::stable_sort(found, [](const ModeDetection& a, const ModeDetection& b) {
    return a.detection.probability > b.detection.probability;
  });
  return found;
}

std::vector<ObjectPose> known_objects(std::span<const ModeDetection> detections,
                                      double min_probability) {
  std::vector<ObjectPose> known;
  for (const ModeDetection& mode : detections)
    if (mode.detection.probability >= min_probability) known.push_back(mode.detection);
  return known;
}

double belief_entropy(std::span<const Mode> modes) {
  double sum = 0;
  for (const Mode& mode : modes)
    for (const double p : {mode.probability, 1 - mode.probability})
      if (p > 0) sum -= p * std::log(p);
  return sum;
}

}  // namespace edgescout
