#include "host/detect/select_detections.h"

#include <algorithm>

#include "host/detect/probability_over_views.h"

namespace edgescout {

namespace {

struct Pool {
  std::vector<ObjectPose> poses;
  std::vector<Registration> registrations;
  std::vector<std::vector<PoseFeatures>> by_view;
  std::vector<double> probabilities;

  void add(const ObjectPose& pose, const Registration& registration,
           const std::vector<PoseFeatures>& features, double probability) {
    poses.push_back(pose);
    registrations.push_back(registration);
    by_view.push_back(features);
    probabilities.push_back(probability);
  }
};

void add_probable(Pool& pool, std::span<const ObjectPose> starts, std::span<const Refined> refined,
                  double min_probability) {
  for (std::size_t i = 0; i < refined.size(); ++i)
    if (const double p = probability_over_views(refined[i].by_view); p >= min_probability)
      pool.add({starts[i].object, refined[i].registration.world_from_object},
               refined[i].registration, refined[i].by_view, p);
}

// Without those that would stand inside a more probable one.
Pool suppress_colliding(const Pool& pool, std::span<const EdgeModel> models, Backend& backend,
                        const DetectOptions& options) {
  const std::vector<double> left = probabilities_without_collisions(
      models, pool.poses, pool.by_view, options.penetration_m, backend.threads());
  Pool apart;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (left[i] >= options.min_probability)
      apart.add(pool.poses[i], pool.registrations[i], pool.by_view[i], left[i]);
  return apart;
}

std::vector<EdgeClaim> compete(const Pool& pool, std::span<const EdgeModel> models,
                               std::span<const RegisterView> views, Backend& backend,
                               const DetectOptions& options) {
  return claim_edges(models, pool.poses, pool.by_view, views, backend, options.edge_claims);
}

}  // namespace

std::vector<Detection> select_detections(std::span<const EdgeModel> models,
                                         std::span<const ObjectPose> poses,
                                         std::span<const Refined> refined,
                                         std::span<const RegisterView> views, Backend& backend,
                                         const DetectOptions& options) {
  Pool pool;
  add_probable(pool, poses, refined, options.min_probability);
  Pool apart = suppress_colliding(pool, models, backend, options);
  std::vector<EdgeClaim> chosen = compete(apart, models, views, backend, options);
  if (options.restart_rotation_rad > 0 && !chosen.empty()) {
    RefineOptions refine = options.refine;
    refine.search.rotation_rad = options.restart_rotation_rad;
    std::vector<ObjectPose> winners;
    for (const EdgeClaim& winner : chosen) winners.push_back(apart.poses[winner.index]);
    add_probable(pool, winners, refine_poses(models, winners, views, backend, refine),
                 options.min_probability);
    apart = suppress_colliding(pool, models, backend, options);
    chosen = compete(apart, models, views, backend, options);
  }
  std::vector<Detection> detections;
  for (const EdgeClaim& c : chosen) {
    detections.push_back(to_detection(apart.poses[c.index].object, apart.registrations[c.index],
                                      pool_over_views(apart.by_view[c.index])));
    detections.back().probability = apart.probabilities[c.index];
  }
  std::ranges::stable_sort(detections, [](const Detection& a, const Detection& b) {
    return a.probability > b.probability;
  });
  if (int(detections.size()) > options.max_detections) detections.resize(options.max_detections);
  return detections;
}

}  // namespace edgescout
