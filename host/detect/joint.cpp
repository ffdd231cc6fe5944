#include "host/detect/joint.h"

#include <algorithm>

#include "host/detect/suppression.h"

namespace edgescout {

namespace {

// All views' candidates of one object in the world, best probability first, without duplicates.
std::vector<Hypothesis> gather(int object, const TemplateSet& set, std::span<const std::vector<std::vector<Scored>>> candidates,
                               std::span<const Observation> observations) {
  struct Entry {
    Se3 world_from_object;
    double probability;
  };
  std::vector<Entry> entries;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    for (const Scored& scored : candidates[v][object])
      entries.push_back({inverse(observations[v].view.camera_from_world) * scored.camera_from_object, scored.probability});
  std::ranges::stable_sort(entries, [](const Entry& a, const Entry& b) { return a.probability > b.probability; });
  std::vector<Se3> poses;
  for (const Entry& entry : entries) poses.push_back(entry.world_from_object);
  std::vector<Hypothesis> gathered;
  for (std::size_t i : suppress_duplicates(poses, set.model.mesh, set.symmetries, 0.05 * set.model.mesh.diameter_m, poses.size()))
    gathered.push_back({object, poses[i]});
  return gathered;
}

}  // namespace

std::vector<Detection> join_views(std::span<const TemplateSet> sets, std::span<const EdgeModel> models,
                                  std::span<const std::vector<std::vector<Scored>>> candidates, std::span<const Observation> observations,
                                  Backend& backend, const DetectOptions& options) {
  std::vector<RegisterView> views;
  for (const Observation& observation : observations) views.push_back(observation.view);
  RefineOptions refine = options.refine;
  // A candidate of one view may be well off along that view's axis: the others see it wide of its edges, so the basin must be wide.
  refine.search.rotation_rad = options.joint_search_rad;
  std::vector<Hypothesis> poses;
  for (std::size_t object = 0; object < sets.size(); ++object) {
    const std::vector<Hypothesis> gathered = gather(int(object), sets[object], candidates, observations);
    poses.insert(poses.end(), gathered.begin(), gathered.end());
  }
  const std::vector<Refined> refined = refine_poses(models, poses, views, backend, refine);
  std::vector<Hypothesis> probable;
  std::vector<PoseFeatures> features;
  std::vector<const Refined*> entries;
  for (std::size_t i = 0; i < refined.size(); ++i)
    if (pose_probability(refined[i].features) >= options.min_probability) {
      probable.push_back({poses[i].object, refined[i].registration.world_from_object});
      features.push_back(refined[i].features);
      entries.push_back(&refined[i]);
    }
  std::vector<Detection> detections;
  for (const ChosenPose& chosen : explain_image(models, probable, features, views, backend, options.evidence))
    detections.push_back(to_detection(probable[chosen.index].object, entries[chosen.index]->registration, features[chosen.index]));
  std::ranges::stable_sort(detections, [](const Detection& a, const Detection& b) { return a.probability > b.probability; });
  if (int(detections.size()) > options.max_detections) detections.resize(options.max_detections);
  return detections;
}

}  // namespace edgescout
