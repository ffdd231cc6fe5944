#include "host/detect/alternatives.h"

#include <algorithm>

#include "host/detect/distinct_poses.h"
#include "host/register/thresholds.h"

namespace edgescout {

namespace {

std::vector<AlternativePose> alternatives_of(const Detection& detection,
                                             std::span<const PoseEstimate> competing,
                                             const TemplateSet& set) {
  const Mesh& mesh = set.model.mesh;
  const Eigen::Vector3d center_m = detection.world_from_object * set.model.center_m;
  std::vector<AlternativePose> here;
  for (const PoseEstimate& pose : competing) {
    if (pose.object != detection.object) continue;
    const double offset_m = (pose.world_from_object * set.model.center_m - center_m).norm(),
                 probability = pose.classification.probability;
    if (offset_m < thresholds::ALTERNATIVE_CENTER * mesh.diameter_m &&
        probability >= ALTERNATIVE_PROBABILITY * detection.probability)
      here.push_back({pose.world_from_object, probability});
  }
  std::ranges::stable_sort(here, std::ranges::greater{}, &AlternativePose::probability);
  KnownPoses listed({&detection.world_from_object, 1}, mesh, set.symmetries);
  std::vector<AlternativePose> alternatives;
  for (const AlternativePose& pose : here) {
    if (listed.any_within(thresholds::ALTERNATIVE_APART * mesh.diameter_m, pose.world_from_object))
      continue;
    listed.add(pose.world_from_object);
    alternatives.push_back(pose);
  }
  return alternatives;
}

}  // namespace

void set_alternatives(std::span<Detection> detections, std::span<const PoseEstimate> competing,
                      std::span<const TemplateSet> sets) {
  for (Detection& detection : detections)
    detection.alternatives =
        alternatives_of(detection, competing, sets[std::size_t(detection.object)]);
}

void share_odds(Detection& detection) {
  const auto odds_of = [](double probability) {
    return probability / std::max(1 - probability, 1e-9);  // finite
  };
  double sum = odds_of(detection.probability);
  for (const AlternativePose& pose : detection.alternatives) sum += odds_of(pose.probability);
  if (detection.alternatives.empty() || sum == 0) return;
  const auto share = [&](double& probability) {
    const double odds = odds_of(probability) * odds_of(probability) / sum;
    probability = odds / (1 + odds);
  };
  share(detection.probability);
  for (AlternativePose& pose : detection.alternatives) share(pose.probability);
}

}  // namespace edgescout
