#include "host/detect/join_views.h"

#include "host/detect/distinct_poses.h"
#include "host/register/thresholds.h"

namespace edgescout {

namespace {

// Candidates that are registered jointly, as multiples of those of one view. A right pose is found
// in several views, so more views do not need more.
constexpr std::size_t MOST_VIEWS = 4;

// The candidates of one object from all views, in the world, most probable first, without
// duplicates.
std::vector<ObjectPose> merge_candidates(std::span<const ObjectView> views, int object,
                                         const TemplateSet& set,
                                         const Grid<std::vector<PoseEstimate>>& candidates,
                                         std::size_t most) {
  std::vector<Se3> world_from_object;
  std::vector<double> keys;
  for (std::size_t v = 0; v < views.size(); ++v)
    for (const PoseEstimate& candidate : candidates(v, std::size_t(object))) {
      world_from_object.push_back(inverse(views[v].camera_from_world) *
                                  candidate.world_from_object);
      keys.push_back(-candidate.classification.probability);
    }
  const double radius_m = thresholds::SAME_ACROSS_VIEWS * set.model.mesh.diameter_m;
  std::vector<ObjectPose> merged;
  for (std::size_t i :
       best_distinct(world_from_object, keys, set.model.mesh, set.symmetries, radius_m, most))
    merged.push_back({object, world_from_object[i]});
  return merged;
}

}  // namespace

std::vector<Detection> join_views(const Scene& scene, std::span<const TemplateSet> sets,
                                  const Grid<std::vector<PoseEstimate>>& candidates,
                                  const DetectOptions& options, SelectionTrace* trace) {
  const std::size_t most = MOST_VIEWS * std::size_t(options.candidates);
  std::vector<ObjectPose> starts;
  for (std::size_t object = 0; object < sets.size(); ++object) {
    const std::vector<ObjectPose> merged =
        merge_candidates(scene.views, int(object), sets[object], candidates, most);
    starts.insert(starts.end(), merged.begin(), merged.end());
  }
  return select_detections(scene, sets, refine_poses(scene, starts, options.refine), options,
                           trace);
}

}  // namespace edgescout
