#include "host/active/reference_objects.h"

#include <algorithm>

namespace edgescout {

namespace {

// Whether the two cannot both exist: the centre of one lies well within the other.
bool overlap(std::span<const EdgeModel> models, const ObjectPose& a, const ObjectPose& b) {
  const EdgeModel &of_a = models[a.object], &of_b = models[b.object];
  const double distance_m =
      (a.world_from_object * of_a.center_m - b.world_from_object * of_b.center_m).norm();
  return distance_m < 0.5 * std::min(of_a.mesh.diameter_m, of_b.mesh.diameter_m);
}

}  // namespace

std::vector<ObjectPose> reference_objects(std::span<const EdgeModel> models,
                                          std::span<const ScoutStep> earlier,
                                          std::span<const ModeDetection> now) {
  std::vector<ObjectPose> all = known_objects(now, 0);
  for (std::size_t i = earlier.size(); i-- > 0;) {
    const std::size_t later = all.size();
    for (const ObjectPose& before : known_objects(earlier[i].detections, 0))
      if (std::none_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(later),
                       [&](const ObjectPose& other) { return overlap(models, before, other); }))
        all.push_back(before);
  }
  return all;
}

}  // namespace edgescout
