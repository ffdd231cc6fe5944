#include "host/detect/select_detections.h"

#include <algorithm>

#include "host/detect/detect.h"
#include "host/register/pose_classifier.h"

namespace edgescout {

namespace {

void append_probable(std::vector<PoseEstimate>& probable, std::span<const PoseEstimate> poses,
                     double min_probability) {
  for (const PoseEstimate& pose : poses)
    if (PoseClassifier::probability(pose.features) >= min_probability) probable.push_back(pose);
}

// The poses that can exist together and explain edges of their own, in the order of their claims.
std::vector<Detection> select(const Scene& scene, std::span<const PoseEstimate> poses,
                              const DetectOptions& options) {
  const std::vector<double> probabilities = probabilities_without_collisions(
      scene.models, poses, options.penetration_m, scene.backend.threads());
  std::vector<PoseEstimate> apart;
  std::vector<double> probabilities_apart;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (probabilities[i] >= options.min_probability) {
      apart.push_back(poses[i]);
      probabilities_apart.push_back(probabilities[i]);
    }
  std::vector<Detection> selected;
  for (const EdgeClaim& claim : claim_edges(scene, apart, options.edge_claims)) {
    selected.push_back(to_detection(apart[claim.index]));
    selected.back().probability = probabilities_apart[claim.index];
  }
  return selected;
}

}  // namespace

std::vector<Detection> select_detections(const Scene& scene,
                                         std::span<const PoseEstimate> candidates,
                                         const DetectOptions& options, SelectionTrace* trace) {
  std::vector<PoseEstimate> probable;
  append_probable(probable, candidates, options.min_probability);
  const std::size_t first_restarted = probable.size();
  std::vector<Detection> detections = select(scene, probable, options);
  if (options.restart_rotation_rad > 0 && !detections.empty()) {
    RefineOptions refine = options.refine;
    refine.search.rotation_rad = options.restart_rotation_rad;
    append_probable(probable, refine_poses(scene, object_poses(detections), refine),
                    options.min_probability);
    detections = select(scene, probable, options);
  }
  std::ranges::stable_sort(detections, [](const Detection& a, const Detection& b) {
    return a.probability > b.probability;
  });
  if (trace) *trace = {std::move(probable), first_restarted, detections};
  if (int(detections.size()) > options.max_detections) detections.resize(options.max_detections);
  return detections;
}

}  // namespace edgescout
