#include "host/experiments/bin_score.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/core/pose_error.h"
#include "host/eval/matching.h"

namespace edgescout {

namespace {

Tally& group_of(BinScore& score, const BinInstance& instance) {
  return instance.visible > LIGHTLY_OCCLUDED ? score.light : score.heavy;
}

// The group of the instance nearest to a wrong pose. Without any instance: highly occluded.
Tally& group_near(BinScore& score, std::span<const BinInstance> instances, const Se3& pose) {
  if (instances.empty()) return score.heavy;
  return group_of(score, *std::ranges::min_element(instances, {}, [&](const BinInstance& instance) {
                    return distance_between_m(instance.world_from_object, pose);
                  }));
}

// `error`: of a detection at an instance of its object; 1 or more if it is not correct.
void match(std::span<const BinInstance> instances, std::span<const ModeDetection> detections,
           BinScore& score, int Tally::*correct, int Tally::*wrong,
           const std::function<double(const Detection&, const BinInstance&)>& error) {
  std::vector<double> errors;
  for (const ModeDetection& mode : detections)
    for (const BinInstance& instance : instances)
      errors.push_back(instance.object == mode.detection.object ? error(mode.detection, instance)
                                                                : INFINITY);
  const std::vector<int> matched = match_in_order(errors, static_cast<int>(instances.size()), 1);
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (matched.empty() || matched[d] == UNMATCHED) {
      ++(group_near(score, instances, detections[d].detection.world_from_object).*wrong);
    } else if (const BinInstance& found = instances[static_cast<std::size_t>(matched[d])];
               found.visible >= LEAST_VISIBLE) {
      ++(group_of(score, found).*correct);
    }
  }
}

// The error of a pose at an instance of its object: below 1 if it is correct.
double error_of(const Se3& pose, const BinInstance& instance, const Object& object) {
  return pose_error(pose, instance.world_from_object, object.symmetries).of_bounds();
}

bool is_followed(const BinInstance& instance, std::span<const Particle> particles,
                 const Object& object) {
  return std::ranges::any_of(particles, [&](const Particle& particle) {
    return particle.object == instance.object &&
           distance_between_m(particle.world_from_object, instance.world_from_object) <
               object.mesh.diameter_m &&
           error_of(particle.world_from_object, instance, object) < 1;
  });
}

}  // namespace

BinScore score_bin(std::span<const BinInstance> instances, const ScoutStep& step,
                   std::span<const Object> objects, const Camera& camera,
                   const Se3& camera_from_world) {
  const auto object_of = [&](int index) -> const Object& {
    return objects[static_cast<std::size_t>(index)];
  };
  BinScore score;
  for (const BinInstance& instance : instances) {
    if (instance.visible < LEAST_VISIBLE) continue;
    Tally& tally = group_of(score, instance);
    ++tally.instances;
    tally.shown += instance.most_visible > LIGHTLY_OCCLUDED;
    tally.followed += is_followed(instance, step.after, object_of(instance.object));
  }
  match(instances, step.detections, score, &Tally::correct, &Tally::wrong,
        [&](const Detection& found, const BinInstance& instance) {
          return error_of(found.world_from_object, instance, object_of(found.object));
        });
  match(instances, step.detections, score, &Tally::correct_px, &Tally::wrong_px,
        [&](const Detection& found, const BinInstance& instance) {
          return mspd_px(camera_from_world * found.world_from_object,
                         camera_from_world * instance.world_from_object, object_of(found.object),
                         camera) /
                 CORRECT_MSPD_PX;
        });
  return score;
}

}  // namespace edgescout
