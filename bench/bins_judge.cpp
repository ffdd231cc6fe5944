#include "bench/bins_judge.h"

#include <algorithm>
#include <functional>

#include "host/eval/metrics.h"

namespace edgescout {

namespace {

Tally& group_of(Judgement& judgement, const Instance& instance) { return instance.visible > LIGHTLY_OCCLUDED ? judgement.light : judgement.heavy; }

const Instance& nearest(std::span<const Instance> instances, const Se3& pose) {
  return *std::ranges::min_element(instances, {}, [&](const Instance& instance) { return distance_between_m(instance.world_from_object, pose); });
}

// `error`: of a detection at an instance of its object, 1 or more where it is not right.
void match(std::span<const Instance> instances, std::span<const ModeDetection> detections, Judgement& judgement, int Tally::*correct, int Tally::*wrong,
           const std::function<double(const Detection&, const Instance&)>& error) {
  std::vector<char> taken(instances.size(), 0);
  for (const ModeDetection& mode : detections) {
    const Detection& found = mode.detection;
    double least = 1;
    std::size_t best = instances.size();
    for (std::size_t i = 0; i < instances.size(); ++i) {
      if (taken[i] || instances[i].object != found.object) continue;
      if (const double e = error(found, instances[i]); e < least) least = e, best = i;
    }
    if (best == instances.size()) {
      ++(group_of(judgement, nearest(instances, found.world_from_object)).*wrong);
      continue;
    }
    taken[best] = 1;
    if (instances[best].visible >= IGNORED) ++(group_of(judgement, instances[best]).*correct);
  }
}

}  // namespace

Judgement judge(std::span<const Instance> instances, std::span<const ModeDetection> detections, std::span<const Object> objects, const Camera& camera,
                const Se3& camera_from_world) {
  Judgement judgement;
  for (const Instance& instance : instances)
    if (instance.visible >= IGNORED) ++group_of(judgement, instance).instances;
  if (instances.empty()) return judgement;
  match(instances, detections, judgement, &Tally::correct, &Tally::wrong, [&](const Detection& found, const Instance& instance) {
    const PoseError e = pose_error(found.world_from_object, instance.world_from_object, objects[static_cast<std::size_t>(found.object)].symmetries);
    return std::max(e.angle_rad / 0.1, e.distance_m / 0.005);
  });
  match(instances, detections, judgement, &Tally::correct_px, &Tally::wrong_px, [&](const Detection& found, const Instance& instance) {
    const Object& object = objects[static_cast<std::size_t>(found.object)];
    return mspd_px(camera_from_world * found.world_from_object, camera_from_world * instance.world_from_object, object, camera) / 10;
  });
  return judgement;
}

}  // namespace edgescout
