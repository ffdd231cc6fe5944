#include "host/active/modes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/order.h"
#include "host/detect/detect.h"
#include "host/detect/probability_over_views.h"
#include "host/detect/suppression.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Of a particle that lives never 0, however small sigma is: its images may still make it probable.
double weight_of(const Particle& particle) {
  const bool lives = particle.log_weight > -std::numeric_limits<double>::infinity();
  return lives ? std::max(std::exp(particle.log_weight), std::numeric_limits<double>::min()) : 0;
}

// Best first: by evidence where particles have been weighed, else by weight.
std::vector<std::size_t> best_first(std::span<const Particle> particles) {
  std::vector<double> merit;
  for (const Particle& particle : particles)
    merit.push_back(particle.by_view.empty() ? particle.log_weight
                                             : psi_z_score(pool_over_views(particle.by_view)));
  return largest_first(merit);
}

// The object's symmetric twin of `pose` that lies nearest to `reference`.
Se3 nearest_twin(const Se3& pose, const Se3& reference, const TemplateSet& set) {
  Se3 nearest = pose;
  double least_m = pose_distance_m(reference, pose, set.model.mesh, Symmetries{});
  for (const Se3& symmetry : set.symmetries.discrete) {
    const double distance_m =
        pose_distance_m(reference, pose * symmetry, set.model.mesh, Symmetries{});
    if (distance_m < least_m) least_m = distance_m, nearest = pose * symmetry;
  }
  return nearest;
}

// Of the mode's poses about the best one.
Matrix6d scatter(std::span<const Particle> particles, const Mode& mode, const TemplateSet& set) {
  const Se3& best = particles[mode.particles[0]].world_from_object;
  Matrix6d sum = Matrix6d::Zero();
  double total = 0;
  for (const std::size_t i : mode.particles) {
    const Vector6d off =
        local_coordinates(best, nearest_twin(particles[i].world_from_object, best, set));
    sum += weight_of(particles[i]) * off * off.transpose();
    total += weight_of(particles[i]);
  }
  return total > 0 ? Matrix6d(sum / total) : sum;
}

Detection to_detection(const Particle& particle, const PoseFeatures& features, double probability) {
  Registration registration;
  registration.world_from_object = particle.world_from_object;
  registration.covariance = particle.covariance;
  Detection detection = to_detection(particle.object, registration, features);
  detection.probability = probability;
  detection.convergence = "particle mode";
  return detection;
}

void exclude_each_other(std::span<Mode> modes, std::span<const Particle> particles,
                        std::span<const EdgeModel> models, double penetration_m, ThreadPool& pool) {
  std::vector<ObjectPose> poses;
  std::vector<std::vector<PoseFeatures>> by_view;
  for (const Mode& mode : modes) {
    const Particle& best = particles[mode.particles[0]];
    poses.push_back({mode.object, best.world_from_object});
    by_view.push_back(best.by_view);
  }
  const std::vector<double> left =
      probabilities_without_collisions(models, poses, by_view, penetration_m, pool);
  for (std::size_t i = 0; i < modes.size(); ++i) modes[i].probability = left[i];
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
    auto home = std::ranges::find_if(modes, [&](const Mode& mode) {
      return mode.object == particle.object &&
             pose_distance_m(particles[mode.particles[0]].world_from_object,
                             particle.world_from_object, set.model.mesh, set.symmetries) < radius_m;
    });
    if (home == modes.end()) {
      home = modes.insert(home, {particle.object, {}, 0, 0});
    }
    home->particles.push_back(i);
    home->weight += weight_of(particle);
  }
  for (Mode& mode : modes) mode.weight /= total;
  exclude_each_other(modes, particles, models, options.penetration_m, pool);
  std::ranges::stable_sort(modes, [](const Mode& a, const Mode& b) { return a.weight > b.weight; });
  return modes;
}

std::vector<ModeDetection> mode_detections(std::span<const Particle> particles,
                                           std::span<const Mode> modes,
                                           std::span<const TemplateSet> sets,
                                           std::span<const EdgeModel> models,
                                           std::span<const RegisterView> views, Backend& backend,
                                           const ModeDetectionOptions& options) {
  std::vector<const Mode*> probable;
  std::vector<ObjectPose> poses;
  std::vector<std::vector<PoseFeatures>> features;
  for (const Mode& mode : modes) {
    if (mode.probability < options.min_probability) continue;
    const Particle& best = particles[mode.particles[0]];
    check(best.by_view.size() == views.size(),
          "mode_detections: particles weighed with these views");
    probable.push_back(&mode);
    poses.push_back({best.object, best.world_from_object});
    features.push_back(best.by_view);
  }
  std::vector<ModeDetection> found;
  for (const EdgeClaim& chosen :
       claim_edges(models, poses, features, views, backend, options.edge_claims)) {
    const Mode& mode = *probable[chosen.index];
    const Particle& best = particles[mode.particles[0]];
    ModeDetection detection{
        to_detection(best, pool_over_views(best.by_view), mode.probability), mode.weight, {}};
    detection.detection.covariance += scatter(particles, mode, sets[mode.object]);
    for (std::size_t v = 0; v < views.size(); ++v)
      if (pose_probability(best.by_view[v]) >= options.support_probability)
        detection.supporting_images.push_back(int(v));
    found.push_back(std::move(detection));
  }
  std::ranges::stable_sort(found, [](const ModeDetection& a, const ModeDetection& b) {
    return a.detection.probability > b.detection.probability;
  });
  return found;
}

std::vector<ObjectPose> known_objects(std::span<const ModeDetection> detections,
                                      double least_probability) {
  std::vector<ObjectPose> known;
  for (const ModeDetection& mode : detections)
    if (mode.detection.probability >= least_probability)
      known.push_back({mode.detection.object, mode.detection.world_from_object});
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
