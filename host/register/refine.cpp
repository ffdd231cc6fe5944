#include "host/register/refine.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/register/coarse_registration.h"
#include "host/register/pose_classifier.h"
#include "host/register/thresholds.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// The start itself first, then the start turned in place about the axes and the cube diagonals of
// the first view's camera frame.
std::vector<ObjectPose> turned_starts(const ObjectPose& start, const EdgeModel& model,
                                      const Se3& camera_from_world, double rotation_rad) {
  std::vector<ObjectPose> starts{start};
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const int axes = std::abs(x) + std::abs(y) + std::abs(z);
        if (axes != 1 && axes != 3) continue;
        Vector6d turn = Vector6d::Zero();
        turn.tail<3>() = camera_from_world.rotation.conjugate() *
                         Eigen::Vector3d(x, y, z).normalized() * rotation_rad;
        starts.push_back(
            {start.object, retract_about(start.world_from_object, model.center_m, turn)});
      }
  return starts;
}

bool same_pose(const Se3& a, const Se3& b, const EdgeModel& model) {
  return (a * model.center_m - b * model.center_m).norm() <
             thresholds::SAME_AFTER_SEARCH * model.mesh.diameter_m &&
         angle_between_rad(a, b) < thresholds::SAME_AFTER_SEARCH_RAD;
}

// Poses that go on to the full registration.
struct SearchResult {
  std::vector<ObjectPose> poses;
  std::vector<std::size_t> start;  // by pose: the start that it belongs to
};

// The poses of one start's search, ranked.
struct RankedPoses {
  std::span<const ObjectPose> poses;
  std::span<const double> ranks;
  std::vector<std::size_t> indices;  // of those of this start
};

// Appends the poses of highest rank that differ from each other.
void keep_best(SearchResult& result, RankedPoses ranked, const Scene& scene, std::size_t start,
               int num_kept) {
  std::ranges::stable_sort(ranked.indices, [&](std::size_t a, std::size_t b) {
    return ranked.ranks[a] > ranked.ranks[b];
  });
  const std::size_t first = result.poses.size();
  for (const std::size_t i : ranked.indices) {
    if (int(result.poses.size() - first) >= num_kept) break;
    const ObjectPose& pose = ranked.poses[i];
    const bool known =
        std::any_of(result.poses.begin() + std::ptrdiff_t(first), result.poses.end(),
                    [&](const ObjectPose& other) {
                      return same_pose(other.world_from_object, pose.world_from_object,
                                       scene.models[std::size_t(pose.object)]);
                    });
    if (known) continue;
    result.poses.push_back(pose);
    result.start.push_back(start);
  }
}

// Registered poses of all turned starts, one start after the other, then the starts as given: the
// coarse registration may lead a start away that fits already.
std::vector<ObjectPose> search_poses(const Scene& scene, std::span<const ObjectPose> starts,
                                     const SearchOptions& options) {
  std::vector<ObjectPose> turned;
  for (const ObjectPose& start : starts)
    for (const ObjectPose& pose :
         turned_starts(start, scene.models[std::size_t(start.object)],
                       scene.views[0].camera_from_world, options.rotation_rad))
      turned.push_back(pose);
  std::vector<ObjectPose> poses = object_poses(register_coarsely(scene, turned, options.coarse));
  poses.insert(poses.end(), starts.begin(), starts.end());
  return poses;
}

SearchResult search(const Scene& scene, std::span<const ObjectPose> starts,
                    const RefineOptions& options) {
  const std::vector<ObjectPose> poses = search_poses(scene, starts, options.search);
  std::vector<double> ranks;
  for (const PoseFeatures& features :
       pooled_features(scene, poses, {options.score, options.search.coarse.visibility}))
    ranks.push_back(PoseClassifier::rank(features));
  const std::size_t turned = poses.size() - starts.size(), of_one = turned / starts.size();
  SearchResult result;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    std::vector<std::size_t> indices(of_one);
    std::iota(indices.begin(), indices.end(), s * of_one);
    indices.push_back(turned + s);
    keep_best(result, {poses, ranks, indices}, scene, s, options.search.num_kept);
  }
  return result;
}

SearchResult without_search(std::span<const ObjectPose> starts) {
  SearchResult result{{starts.begin(), starts.end()}, std::vector<std::size_t>(starts.size())};
  std::iota(result.start.begin(), result.start.end(), 0);
  return result;
}

double log_odds(const PoseEstimate& estimate) {
  return PoseClassifier::log_odds(pool_over_views(estimate.features));
}

// The most probable estimate per start; the first of equal ones.
std::vector<PoseEstimate> best_per_start(std::span<const PoseEstimate> estimates,
                                         std::span<const std::size_t> start, std::size_t starts) {
  std::vector<PoseEstimate> best(starts);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    PoseEstimate& known = best[start[i]];
    const bool is_first = known.features.empty();
    if (is_first || !(log_odds(known) >= log_odds(estimates[i]))) known = estimates[i];
  }
  return best;
}

// The steps of the last stage need not become as small as its own limit: that would cost more
// iterations than the pose is worth.
void judge_last_step(std::span<PoseEstimate> estimates) {
  for (PoseEstimate& estimate : estimates)
    if (estimate.convergence == Convergence::IterationLimit &&
        estimate.last_step_px < thresholds::CONVERGED_PX)
      estimate.convergence = Convergence::Converged;
}

// Of one view. Several show the tilt and the distance of a pose well enough.
void hop_promising(const Scene& scene, std::span<PoseEstimate> estimates,
                   const RefineOptions& options) {
  constexpr double least_log_odds = -2;  // others hardly end above the default threshold
  std::vector<std::size_t> indices;
  std::vector<PoseEstimate> promising;
  for (std::size_t i = 0; i < estimates.size(); ++i)
    if (log_odds(estimates[i]) >= least_log_odds) {
      indices.push_back(i);
      promising.push_back(estimates[i]);
    }
  if (promising.empty()) return;
  hop_basins(scene, promising, options.edge_icp);
  measure_features(scene, promising, {options.score, options.d2co.visibility});
  for (std::size_t k = 0; k < indices.size(); ++k) estimates[indices[k]] = promising[k];
}

std::vector<PoseEstimate> refine_batch(const Scene& scene, std::span<const ObjectPose> starts,
                                       const RefineOptions& options) {
  const bool searched = options.search.rotation_rad > 0 && !scene.is_time_over();
  const SearchResult found = searched ? search(scene, starts, options) : without_search(starts);
  D2coOptions d2co = options.d2co;
  if (options.search.rotation_rad == 0) d2co.rounds.insert(d2co.rounds.begin(), options.unsearched);
  std::vector<PoseEstimate> estimates = register_poses(scene, found.poses, d2co);
  if (options.use_edge_icp && !scene.is_time_over()) edge_icp(scene, estimates, options.edge_icp);
  measure_features(scene, estimates, {options.score, options.d2co.visibility});
  if (options.use_edge_icp && scene.views.size() == 1 && !scene.is_time_over())
    hop_promising(scene, estimates, options);
  judge_last_step(estimates);
  return best_per_start(estimates, found.start, starts.size());
}

}  // namespace

void describe(RefineOptions& o, OptionVisitor& visit) {
  visit.group("Registration");
  visit.number({"search-rotation",
                "Angle by which turned copies of each start are rotated, about 14 axes, rad. 0: "
                "only the given start"},
               o.search.rotation_rad, 0.0, 1.0);
  visit.number({"search-kept",
                "Number of the best starts of each pose, the given and the turned ones, that are "
                "registered in full"},
               o.search.num_kept, 1, 15);
  describe_solver(o.d2co, visit);
  visit.flag({"edge-icp", "Refine the registered poses on sub-pixel edge points (default)"},
             o.use_edge_icp);
}

void RefineOptions::validate() const {
  check_bounds(*this, "register");
  search.coarse.validate();
  d2co.validate();
  edge_icp.validate();
  if (batch_size < 1)
    throw InputError("options", "register.batch_size", std::to_string(batch_size), "at least 1");
}

std::vector<PoseEstimate> refine_poses(const Scene& scene, std::span<const ObjectPose> starts,
                                       const RefineOptions& options) {
  options.validate();
  check(!scene.views.empty(), "refine_poses: at least one view");
  const std::size_t batch =
      std::max<std::size_t>(1, std::size_t(options.batch_size) / scene.views.size());
  std::vector<PoseEstimate> results;
  for (std::size_t first = 0; first < starts.size(); first += batch) {
    std::vector<PoseEstimate> refined =
        refine_batch(scene, starts.subspan(first, std::min(batch, starts.size() - first)), options);
    std::ranges::move(refined, std::back_inserter(results));
  }
  return results;
}

}  // namespace edgescout
