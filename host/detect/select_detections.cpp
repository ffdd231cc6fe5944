#include "host/detect/select_detections.h"

#include <algorithm>

#include "host/detect/alternatives.h"
#include "host/detect/search_space.h"

namespace edgescout {

namespace {

// Poses of a lower probability do not compete. Those below the threshold of reported poses do: the
// refinement from turned starts may raise them above it.
double least_competing(const DetectOptions& options) {
  constexpr double most = 0.05;
  return std::min(most, options.min_probability);
}

// The poses that are probable enough to compete, and that the prior admits.
class Competitors {
 public:
  Competitors(const Scene& scene, const DetectOptions& options)
      : least_probability_(least_competing(options)) {
    if (options.scan.world.is_given()) spaces_ = search_spaces(options.scan.world, scene.models);
  }

  void append(std::span<const PoseEstimate> poses) {
    for (const PoseEstimate& pose : poses)
      if (pose.classification.probability >= least_probability_ && is_admitted(pose))
        poses_.push_back(pose);
  }
  const std::vector<PoseEstimate>& poses() const { return poses_; }

 private:
  bool is_admitted(const ObjectPose& pose) const {
    return spaces_.empty() || spaces_[std::size_t(pose.object)].admits(pose.world_from_object);
  }

  std::vector<SearchSpace> spaces_;  // by object; empty: no prior is given
  double least_probability_;
  std::vector<PoseEstimate> poses_;
};

// The poses that can exist together and explain edges of their own, in the order of their claims.
std::vector<Detection> select(const Scene& scene, std::span<const PoseEstimate> poses,
                              const DetectOptions& options) {
  const std::vector<double> probabilities = probabilities_without_collisions(
      scene.models, poses, options.penetration_m, scene.backend.threads());
  std::vector<PoseEstimate> apart;
  std::vector<double> probabilities_apart;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (probabilities[i] >= least_competing(options)) {
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

Detection to_detection(const PoseEstimate& estimate) {
  const PoseClassification& classification = estimate.classification;
  Detection d;
  d.object = estimate.object;
  d.world_from_object = estimate.world_from_object;
  d.covariance = estimate.covariance;
  d.probability = classification.probability;
  d.psi = classification.pooled.psi;
  d.cost_px = classification.pooled.mean_px;
  d.matched_fraction = classification.pooled.matched;
  d.psi_z_score = classification.psi_z_score;
  d.unexplained_grey = classification.unexplained_grey;
  d.convergence = to_string(estimate.convergence);
  return d;
}

std::vector<Detection> select_detections(const Scene& scene, std::span<const TemplateSet> sets,
                                         std::span<const PoseEstimate> candidates,
                                         const DetectOptions& options, SelectionTrace* trace) {
  Competitors competing(scene, options);
  competing.append(candidates);
  const std::size_t first_restarted = competing.poses().size();
  std::vector<Detection> detections = select(scene, competing.poses(), options);
  if (options.restart_rotation_rad > 0 && !detections.empty() && !scene.is_time_over()) {
    RefineOptions refine = options.refine;
    refine.search.rotation_rad = options.restart_rotation_rad;
    competing.append(refine_poses(scene, object_poses(detections), refine));
    detections = select(scene, competing.poses(), options);
  }
  set_alternatives(detections, competing.poses(), sets);
  for (Detection& detection : detections) share_odds(detection);
  const auto too_improbable = std::ranges::stable_partition(
      detections, [&](const Detection& d) { return d.probability >= options.min_probability; });
  const std::vector<Detection> less_probable(too_improbable.begin(), too_improbable.end());
  detections.erase(too_improbable.begin(), too_improbable.end());
  std::ranges::stable_sort(detections, [](const Detection& a, const Detection& b) {
    return a.probability > b.probability;
  });
  if (trace) *trace = {competing.poses(), first_restarted, detections, less_probable};
  if (int(detections.size()) > options.max_detections) detections.resize(options.max_detections);
  return detections;
}

}  // namespace edgescout
