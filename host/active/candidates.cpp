#include "host/active/candidates.h"

#include <algorithm>

#include "host/core/order.h"
#include "host/detect/probability_over_views.h"
#include "host/detect/rescore_in_views.h"
#include "host/detect/suppression.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

void sort_by_probability(std::vector<Detection>& detections) {
  std::ranges::stable_sort(detections, [](const Detection& a, const Detection& b) {
    return a.probability > b.probability;
  });
}

// Best first. Duplicates exist within one object only.
std::vector<Detection> different_ones(const std::vector<Detection>& detections,
                                      std::span<const TemplateSet> sets) {
  std::vector<Detection> kept;
  for (std::size_t object = 0; object < sets.size(); ++object) {
    std::vector<Detection> same;
    std::vector<Se3> poses;
    std::vector<double> keys;
    for (const Detection& d : detections)
      if (d.object == static_cast<int>(object)) {
        same.push_back(d);
        poses.push_back(d.world_from_object);
        keys.push_back(-d.probability);
      }
    const Mesh& mesh = sets[object].model.mesh;
    for (std::size_t i : best_distinct(poses, keys, mesh, sets[object].symmetries,
                                       0.1 * mesh.diameter_m, poses.size()))
      kept.push_back(same[i]);
  }
  sort_by_probability(kept);
  return kept;
}

std::vector<double> capped_probabilities(std::span<const Detection> detections) {
  constexpr double surest = 0.98;  // what that excludes stays ahead of what has hardly a chance
  std::vector<double> probabilities;
  for (const Detection& detection : detections)
    probabilities.push_back(std::min(detection.probability, surest));
  return probabilities;
}

// Of 40,000 an image, of which the known instances' are left out.
constexpr std::size_t HITS_JUDGED = 20000;

std::vector<ScanHit> hits_of(const TemplateSet& set, std::size_t object,
                             std::span<const Observation> images, std::span<const Se3> known,
                             Backend& backend, const DetectOptions& options) {
  std::vector<std::span<const ScanHit>> hits;
  for (const Observation& image : images) {
    check(object < image.hits.size(), "candidates_in_images: an image that was not scanned");
    hits.push_back(*image.hits[object]);
  }
  return pooled_hits(set, images, hits, options.support_views,
                     near_known(known, set, images.back().view.camera_from_world), HITS_JUDGED,
                     backend, options.scan);
}

}  // namespace

std::vector<Detection> candidates_in_images(std::span<const TemplateSet> sets,
                                            std::span<const Observation> images,
                                            std::span<const ObjectPose> known, Backend& backend,
                                            const DetectOptions& options) {
  const Observation& newest = images.back();
  std::vector<Detection> found;
  for (std::size_t object = 0; object < sets.size(); ++object) {
    std::vector<Se3> same;
    for (const ObjectPose& instance : known)
      if (instance.object == static_cast<int>(object)) same.push_back(instance.world_from_object);
    for (const Refined& candidate : find_candidates(
             sets[object], hits_of(sets[object], object, images, same, backend, options), newest,
             images.first(images.size() - 1), same, backend, options)) {
      found.push_back(candidate_in_world(
          to_detection(static_cast<int>(object), candidate.registration, candidate.features),
          newest.view.camera_from_world));
      found.back().probability = probability_over_views(candidate.by_view);
    }
  }
  sort_by_probability(found);
  return found;
}

std::vector<Detection> refined_candidates(std::span<const TemplateSet> sets,
                                          std::span<const EdgeModel> models,
                                          std::span<const Detection> candidates,
                                          std::span<const RegisterView> views, std::size_t most,
                                          Backend& backend, const DetectOptions& options) {
  const std::vector<ObjectPose> starts = poses_of(candidates);
  RefineOptions refine = options.refine;
  refine.search.rotation_rad = 0;  // the search around them was made in their own images
  const std::vector<Refined> refined = refine_poses(models, starts, views, backend, refine);
  std::vector<Detection> detections;
  for (std::size_t i = 0; i < refined.size(); ++i) {
    if (refined[i].features.matched == 0) continue;
    detections.push_back(
        to_detection(starts[i].object, refined[i].registration, refined[i].features));
    detections.back().probability = probability_over_views(refined[i].by_view);
  }
  return best_non_colliding(different_ones(detections, sets), most, models, options.penetration_m,
                            backend.threads());
}

std::vector<Detection> best_non_colliding(const std::vector<Detection>& candidates,
                                          std::size_t most, std::span<const EdgeModel> models,
                                          double penetration_m, ThreadPool& pool) {
  if (candidates.size() <= most) return candidates;
  std::vector<std::size_t> chosen = largest_first(
      exclusive_probabilities(capped_probabilities(candidates),
                              plausible_pairs(models, poses_of(candidates), penetration_m, pool)));
  chosen.resize(most);
  std::ranges::sort(chosen);
  std::vector<Detection> kept;
  for (const std::size_t i : chosen) kept.push_back(candidates[i]);
  return kept;
}

namespace {

// Particles or candidates.
bool near_any(const Detection& candidate, const auto& others, std::span<const TemplateSet> sets,
              double radius) {
  const TemplateSet& set = sets[static_cast<std::size_t>(candidate.object)];
  return std::ranges::any_of(others, [&](const auto& other) {
    return other.object == candidate.object &&
           pose_distance_m(other.world_from_object, candidate.world_from_object, set.model.mesh,
                           set.symmetries) < radius * set.model.mesh.diameter_m;
  });
}

}  // namespace

std::vector<Detection> without_particles(std::span<const Detection> candidates,
                                         std::span<const Particle> particles,
                                         std::span<const TemplateSet> sets, double radius,
                                         double min_probability) {
  std::vector<Detection> unknown;
  for (const Detection& candidate : candidates)
    if (candidate.probability >= min_probability && !near_any(candidate, particles, sets, radius))
      unknown.push_back(candidate);
  return unknown;
}

std::size_t count_new(std::span<const Detection> candidates, std::span<const Detection> before,
                      std::span<const TemplateSet> sets, double radius) {
  return static_cast<std::size_t>(std::ranges::count_if(
      candidates,
      [&](const Detection& candidate) { return !near_any(candidate, before, sets, radius); }));
}

}  // namespace edgescout
