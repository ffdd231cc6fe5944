#include "host/register/probable_hops.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "host/register/edge_icp.h"
#include "host/register/pose_classifier.h"
#include "host/register/pose_tolerance.h"

namespace edgescout {

namespace {

constexpr double LEAST_LOG_ODDS = -4;  // others hardly end above the default threshold

// Estimates of one pose.
struct DistinctPose {
  std::size_t best;  // the most probable one
  std::vector<std::size_t> others;
};

// The indices of probable estimates, most probable first.
std::vector<std::size_t> probable(std::span<const PoseEstimate> estimates) {
  std::vector<double> log_odds;
  for (const PoseEstimate& estimate : estimates)
    log_odds.push_back(PoseClassifier::log_odds(pool_over_views(estimate.features)));
  std::vector<std::size_t> indices(estimates.size());
  std::iota(indices.begin(), indices.end(), 0);
  std::erase_if(indices, [&](std::size_t i) { return !(log_odds[i] >= LEAST_LOG_ODDS); });
  std::ranges::stable_sort(indices, std::greater{}, [&](std::size_t i) { return log_odds[i]; });
  return indices;
}

std::vector<DistinctPose> distinct(const Scene& scene, std::span<const PoseEstimate> estimates,
                                   std::span<const std::size_t> best_first) {
  std::vector<DistinctPose> poses;
  for (const std::size_t i : best_first) {
    const auto known = std::ranges::find_if(poses, [&](const DistinctPose& pose) {
      return is_same_pose(estimates[pose.best], estimates[i], scene, thresholds::SAME_END);
    });
    if (known == poses.end())
      poses.push_back({i, {}});
    else
      known->others.push_back(i);
  }
  return poses;
}

}  // namespace

void hop_probable(const Scene& scene, std::span<PoseEstimate> estimates,
                  const EdgeIcpOptions& options, const FeatureOptions& measure) {
  const std::vector<DistinctPose> poses = distinct(scene, estimates, probable(estimates));
  std::vector<PoseEstimate> hopping;
  for (const DistinctPose& pose : poses) hopping.push_back(estimates[pose.best]);
  const std::vector<std::size_t> moved = hop_basins(scene, hopping, options);
  if (moved.empty()) return;
  std::vector<PoseEstimate> ends;
  for (const std::size_t i : moved) ends.push_back(hopping[i]);
  measure_features(scene, ends, measure);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const DistinctPose& pose = poses[moved[k]];
    estimates[pose.best] = ends[k];
    for (const std::size_t other : pose.others) estimates[other] = ends[k];
  }
}

}  // namespace edgescout
