#include "host/active/candidates.h"

#include <algorithm>

#include "host/core/order.h"
#include "host/detect/detect.h"
#include "host/detect/distinct_poses.h"
#include "host/detect/rescore_in_views.h"
#include "host/detect/search_space.h"
#include "host/register/depth_evidence.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Hits that the quick rescoring keeps, of 40,000 per image without those on known instances.
constexpr std::size_t MAX_RESCORED_HITS = 20000;

void sort_by_probability(std::vector<Detection>& detections) {
  std::ranges::stable_sort(detections, [](const Detection& a, const Detection& b) {
    return a.probability > b.probability;
  });
}

// Most probable first. Only detections of one object can be duplicates.
std::vector<Detection> without_duplicates(const std::vector<Detection>& detections,
                                          std::span<const TemplateSet> sets) {
  std::vector<Detection> kept;
  for (std::size_t object = 0; object < sets.size(); ++object) {
    std::vector<Detection> same_object;
    std::vector<Se3> poses;
    std::vector<double> keys;
    for (const Detection& d : detections)
      if (d.object == static_cast<int>(object)) {
        same_object.push_back(d);
        poses.push_back(d.world_from_object);
        keys.push_back(-d.probability);
      }
    const Mesh& mesh = sets[object].model.mesh;
    for (std::size_t i : best_distinct(poses, keys, mesh, sets[object].symmetries,
                                       thresholds::SAME_POSE * mesh.diameter_m, poses.size()))
      kept.push_back(same_object[i]);
  }
  sort_by_probability(kept);
  return kept;
}

std::vector<double> capped_probabilities(std::span<const Detection> detections) {
  // A candidate that collides with a certain one still ranks above one with hardly a chance.
  constexpr double max_probability = 0.98;
  std::vector<double> probabilities;
  for (const Detection& detection : detections)
    probabilities.push_back(std::min(detection.probability, max_probability));
  return probabilities;
}

std::vector<Se3> poses_of_object(std::span<const ObjectPose> poses, std::size_t object) {
  std::vector<Se3> same_object;
  for (const ObjectPose& pose : poses)
    if (pose.object == static_cast<int>(object)) same_object.push_back(pose.world_from_object);
  return same_object;
}

std::vector<std::span<const ScanHit>> hits_of_object(std::span<const ScannedView> images,
                                                     std::size_t object) {
  std::vector<std::span<const ScanHit>> hits;
  for (const ScannedView& image : images) {
    check(object < image.hits.size(), "candidates_in_images: an image that was not scanned");
    hits.push_back(*image.hits[object]);
  }
  return hits;
}

// `known`: poses of particles or candidates, or of what else derives from ObjectPose.
bool near_any(const Detection& candidate, const auto& known, std::span<const TemplateSet> sets,
              double radius) {
  const TemplateSet& set = sets[static_cast<std::size_t>(candidate.object)];
  return std::ranges::any_of(known, [&](const ObjectPose& other) {
    return other.object == candidate.object &&
           pose_distance_m(other.world_from_object, candidate.world_from_object, set.model.mesh,
                           set.symmetries) < radius * set.model.mesh.diameter_m;
  });
}

}  // namespace

std::vector<Detection> candidates_in_images(std::span<const TemplateSet> sets,
                                            std::span<const ScannedView> images,
                                            std::span<const ObjectPose> known, Backend& backend,
                                            const DetectOptions& options, const TimeLimit* limit) {
  const std::vector<ObjectView> views = views_of(images);
  const ObjectView& newest = views.back();
  std::vector<Detection> found;
  for (std::size_t object = 0; object < sets.size(); ++object) {
    const TemplateSet& set = sets[object];
    const std::vector<Se3> known_poses = poses_of_object(known, object);
    const PoolOptions pool{options.scan, options.support_views, MAX_RESCORED_HITS,
                           near_known(known_poses, set, newest.camera_from_world)};
    const std::vector<ScanHit> hits =
        pooled_hits(set, views, hits_of_object(images, object), backend, pool);
    const ObjectSearch search{set,     newest,  std::span(views).first(views.size() - 1),
                              backend, nullptr, limit};
    for (const PoseEstimate& candidate : find_candidates(search, hits, known_poses, options)) {
      found.push_back(candidate_in_world(to_detection(candidate), newest.camera_from_world));
      found.back().object = static_cast<int>(object);
    }
  }
  sort_by_probability(found);
  return found;
}

std::vector<Detection> refined_candidates(const Scene& scene, std::span<const TemplateSet> sets,
                                          std::span<const Detection> candidates, std::size_t most,
                                          const DetectOptions& options) {
  RefineOptions refine = options.refine;
  refine.search.rotation_rad = 0;  // the search around them was made in their own images
  const std::vector<SearchSpace> spaces = search_spaces(options.scan.world, scene.models);
  std::vector<Detection> detections;
  for (const PoseEstimate& estimate : refine_poses(scene, object_poses(candidates), refine)) {
    const auto object = std::size_t(estimate.object);
    // Further images may move a pose from beside the prior into it.
    const SearchSlack slack{thresholds::SAME_POSE * scene.models[object].mesh.diameter_m};
    const PoseFeatures& pooled = estimate.classification.pooled;
    if (pooled.matched == 0 || is_contradicted(pooled.depth) ||
        !spaces[object].admits(estimate.world_from_object, slack))
      continue;
    detections.push_back(to_detection(estimate));
  }
  return best_non_colliding(without_duplicates(detections, sets), most, scene.models,
                            options.penetration_m, scene.backend.threads());
}

std::vector<Detection> best_non_colliding(const std::vector<Detection>& candidates,
                                          std::size_t most, std::span<const EdgeModel> models,
                                          double penetration_m, ThreadPool& pool) {
  if (candidates.size() <= most) return candidates;
  const BitMatrix plausible =
      plausible_pairs(models, object_poses(candidates), penetration_m, pool);
  std::vector<std::size_t> chosen =
      largest_first(exclusive_probabilities(capped_probabilities(candidates), plausible));
  chosen.resize(most);
  std::ranges::sort(chosen);
  std::vector<Detection> kept;
  for (const std::size_t i : chosen) kept.push_back(candidates[i]);
  return kept;
}

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
