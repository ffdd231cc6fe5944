#include "host/detect/joint.h"

#include "host/detect/probability_over_views.h"
#include "host/detect/suppression.h"

namespace edgescout {

namespace {

// the best of all views, as many as these have: what is right is found in several
constexpr std::size_t VIEWS_WORTH = 4;

// All views' candidates of one object in the world, best probability first, without duplicates.
std::vector<ObjectPose> gather(int object, const TemplateSet& set,
                               std::span<const std::vector<std::vector<Refined>>> candidates,
                               std::span<const Observation> observations, std::size_t most) {
  std::vector<Se3> poses;
  std::vector<double> keys;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    for (const Refined& refined : candidates[v][static_cast<std::size_t>(object)]) {
      poses.push_back(inverse(observations[v].view.camera_from_world) *
                      refined.registration.world_from_object);
      keys.push_back(-probability_over_views(refined.by_view));
    }
  std::vector<ObjectPose> gathered;
  for (std::size_t i : best_distinct(poses, keys, set.model.mesh, set.symmetries,
                                     0.05 * set.model.mesh.diameter_m, most))
    gathered.push_back({object, poses[i]});
  return gathered;
}

}  // namespace

std::vector<Detection> join_views(std::span<const TemplateSet> sets,
                                  std::span<const EdgeModel> models,
                                  std::span<const std::vector<std::vector<Refined>>> candidates,
                                  std::span<const Observation> observations, Backend& backend,
                                  const DetectOptions& options) {
  const std::vector<RegisterView> views = views_of(observations);
  std::vector<ObjectPose> poses;
  for (std::size_t object = 0; object < sets.size(); ++object) {
    const std::vector<ObjectPose> gathered =
        gather(int(object), sets[object], candidates, observations,
               VIEWS_WORTH * std::size_t(options.candidates));
    poses.insert(poses.end(), gathered.begin(), gathered.end());
  }
  const std::vector<Refined> refined = refine_poses(models, poses, views, backend, options.refine);
  return select_detections(models, poses, refined, views, backend, options);
}

}  // namespace edgescout
