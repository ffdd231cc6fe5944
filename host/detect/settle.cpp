#include "host/detect/settle.h"

#include <algorithm>

#include "host/detect/probability_over_views.h"

namespace edgescout {

namespace {

// One view may see what the others do not.
double probability_of(const Refined& refined) { return probability_over_views(refined.by_view); }

struct Pool {
  std::vector<Hypothesis> poses;
  std::vector<Refined> refined;
};

void add_probable(Pool& pool, std::span<const Hypothesis> starts, std::span<const Refined> refined,
                  double min_probability) {
  for (std::size_t i = 0; i < refined.size(); ++i) {
    if (probability_of(refined[i]) < min_probability) continue;
    pool.poses.push_back({starts[i].object, refined[i].registration.world_from_object});
    pool.refined.push_back(refined[i]);
  }
}

std::vector<ChosenPose> compete(const Pool& pool, std::span<const EdgeModel> models,
                                std::span<const RegisterView> views, Backend& backend,
                                const DetectOptions& options) {
  std::vector<PoseFeatures> features;
  for (const Refined& r : pool.refined) features.push_back(r.features);
  return explain_image(models, pool.poses, features, views, backend, options.evidence);
}

}  // namespace

std::vector<Detection> settle(std::span<const EdgeModel> models, std::span<const Hypothesis> poses,
                              std::span<const Refined> refined, std::span<const RegisterView> views,
                              Backend& backend, const DetectOptions& options) {
  Pool pool;
  add_probable(pool, poses, refined, options.min_probability);
  std::vector<ChosenPose> chosen = compete(pool, models, views, backend, options);
  if (options.second_look_rad > 0 && !chosen.empty()) {
    RefineOptions refine = options.refine;
    refine.search.rotation_rad = options.second_look_rad;
    std::vector<Hypothesis> winners;
    for (const ChosenPose& winner : chosen) winners.push_back(pool.poses[winner.index]);
    add_probable(pool, winners, refine_poses(models, winners, views, backend, refine),
                 options.min_probability);
    chosen = compete(pool, models, views, backend, options);
  }
  std::vector<Detection> detections;
  for (const ChosenPose& c : chosen) {
    const Refined& refined_pose = pool.refined[c.index];
    detections.push_back(
        to_detection(pool.poses[c.index].object, refined_pose.registration, refined_pose.features));
    detections.back().probability = probability_of(refined_pose);
  }
  std::ranges::stable_sort(
      detections, [](const Detection& a, const Detection& b) { return a.probability > b.probability; });
  if (int(detections.size()) > options.max_detections) detections.resize(options.max_detections);
  return detections;
}

}  // namespace edgescout
