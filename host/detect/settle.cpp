#include "host/detect/settle.h"

#include <algorithm>

#include "host/detect/probability_over_views.h"

namespace edgescout {

namespace {

struct Pool {
  std::vector<Hypothesis> poses;
  std::vector<Refined> refined;
  std::vector<double> probabilities;

  void add(const Hypothesis& pose, const Refined& r, double probability) {
    poses.push_back(pose);
    refined.push_back(r);
    probabilities.push_back(probability);
  }
};

void add_probable(Pool& pool, std::span<const Hypothesis> starts, std::span<const Refined> refined,
                  double min_probability) {
  for (std::size_t i = 0; i < refined.size(); ++i)
    if (const double p = probability_over_views(refined[i].by_view); p >= min_probability)
      pool.add({starts[i].object, refined[i].registration.world_from_object}, refined[i], p);
}

// Without those that would stand inside a more probable one. A single view says too little of how far away
// poses are.
Pool standing_apart(const Pool& pool, std::span<const EdgeModel> models, std::size_t views, Backend& backend,
                    const DetectOptions& options) {
  if (views < 2) return pool;
  const std::vector<double> left = exclusive_probabilities(
      pool.probabilities, plausible_pairs(models, pool.poses, options.penetration_m, backend.threads()));
  Pool apart;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (left[i] >= options.min_probability) apart.add(pool.poses[i], pool.refined[i], left[i]);
  return apart;
}

std::vector<ChosenPose> compete(const Pool& pool, std::span<const EdgeModel> models,
                                std::span<const RegisterView> views, Backend& backend,
                                const DetectOptions& options) {
  std::vector<std::vector<PoseFeatures>> features;
  for (const Refined& r : pool.refined) features.push_back(r.by_view);
  return explain_image(models, pool.poses, features, views, backend, options.evidence);
}

}  // namespace

std::vector<Detection> settle(std::span<const EdgeModel> models, std::span<const Hypothesis> poses,
                              std::span<const Refined> refined, std::span<const RegisterView> views,
                              Backend& backend, const DetectOptions& options) {
  Pool pool;
  add_probable(pool, poses, refined, options.min_probability);
  pool = standing_apart(pool, models, views.size(), backend, options);
  std::vector<ChosenPose> chosen = compete(pool, models, views, backend, options);
  if (options.second_look_rad > 0 && !chosen.empty()) {
    RefineOptions refine = options.refine;
    refine.search.rotation_rad = options.second_look_rad;
    std::vector<Hypothesis> winners;
    for (const ChosenPose& winner : chosen) winners.push_back(pool.poses[winner.index]);
    add_probable(pool, winners, refine_poses(models, winners, views, backend, refine),
                 options.min_probability);
    pool = standing_apart(pool, models, views.size(), backend, options);
    chosen = compete(pool, models, views, backend, options);
  }
  std::vector<Detection> detections;
  for (const ChosenPose& c : chosen) {
    const Refined& refined_pose = pool.refined[c.index];
    detections.push_back(
        to_detection(pool.poses[c.index].object, refined_pose.registration, refined_pose.features));
    detections.back().probability = pool.probabilities[c.index];
  }
  std::ranges::stable_sort(
      detections, [](const Detection& a, const Detection& b) { return a.probability > b.probability; });
  if (int(detections.size()) > options.max_detections) detections.resize(options.max_detections);
  return detections;
}

}  // namespace edgescout
