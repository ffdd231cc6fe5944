#include "host/register/refine.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "host/register/coarse_registration.h"
#include "host/register/pose_tolerance.h"
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

// Poses that go on to the full registration.
struct SearchResult {
  std::vector<ObjectPose> poses;
  std::vector<std::size_t> start;  // by pose: the start that it belongs to
};

// The poses of one start's search, ranked.
struct RankedPoses {
  std::span<const PoseEstimate> poses;
  std::vector<std::size_t> indices;  // of those of this start
};

// Appends the poses of highest rank that differ from each other.
void keep_best(SearchResult& result, RankedPoses ranked, const Scene& scene, std::size_t start,
               int num_kept) {
  std::ranges::stable_sort(ranked.indices, [&](std::size_t a, std::size_t b) {
    return ranked.poses[a].classification.pooled_rank > ranked.poses[b].classification.pooled_rank;
  });
  const std::size_t first = result.poses.size();
  for (const std::size_t i : ranked.indices) {
    if (int(result.poses.size() - first) >= num_kept) break;
    const ObjectPose& pose = ranked.poses[i];
    const bool known =
        std::any_of(result.poses.begin() + std::ptrdiff_t(first), result.poses.end(),
                    [&](const ObjectPose& other) {
                      return is_same_pose(other, pose, scene, thresholds::SAME_AFTER_SEARCH);
                    });
    if (known) continue;
    result.poses.push_back(pose);
    result.start.push_back(start);
  }
}

// Measures the features at the poses where they are now.
void measure(const Scene& scene, std::span<PoseEstimate> poses, const RefineOptions& options,
             const D2coOptions& registered_by) {
  measure_features(scene, poses, {options.score, registered_by.visibility});
}

// Registered poses of all turned starts, one start after the other, then the starts as given: the
// coarse registration may lead a start away that fits already. With features.
std::vector<PoseEstimate> search_poses(const Scene& scene, std::span<const ObjectPose> starts,
                                       const RefineOptions& options) {
  const SearchOptions& search = options.search;
  std::vector<ObjectPose> turned;
  for (const ObjectPose& start : starts)
    for (const ObjectPose& pose :
         turned_starts(start, scene.models[std::size_t(start.object)],
                       scene.views[0].camera_from_world, search.rotation_rad))
      turned.push_back(pose);
  std::vector<PoseEstimate> poses = register_coarsely(scene, turned, search.coarse);
  for (const ObjectPose& start : starts) static_cast<ObjectPose&>(poses.emplace_back()) = start;
  measure(scene, poses, options, search.coarse);
  return poses;
}

SearchResult search(const Scene& scene, std::span<const ObjectPose> starts,
                    const RefineOptions& options) {
  const std::vector<PoseEstimate> poses = search_poses(scene, starts, options);
  const std::size_t turned = poses.size() - starts.size(), of_one = turned / starts.size();
  SearchResult result;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    std::vector<std::size_t> indices(of_one);
    std::iota(indices.begin(), indices.end(), s * of_one);
    indices.push_back(turned + s);
    keep_best(result, {poses, indices}, scene, s, options.search.num_kept);
  }
  return result;
}

SearchResult without_search(std::span<const ObjectPose> starts) {
  SearchResult result{{starts.begin(), starts.end()}, std::vector<std::size_t>(starts.size())};
  std::iota(result.start.begin(), result.start.end(), 0);
  return result;
}

// How much speaks for one of several ends of a start. The probability says little of which of two
// neighbouring optima is right; the share of the points that edges explain says more. The weight
// was chosen on the ends of 346 starts (docs/research/registration.md).
double preference(const PoseEstimate& estimate) {
  constexpr double of_explained = 5;
  return estimate.classification.pooled_log_odds + of_explained * estimate.explained;
}

// The preferred estimate per start; the first of equal ones.
std::vector<PoseEstimate> best_per_start(std::span<const PoseEstimate> estimates,
                                         std::span<const std::size_t> start, std::size_t starts) {
  std::vector<PoseEstimate> best(starts);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    PoseEstimate& known = best[start[i]];
    const bool is_first = known.features.empty();
    if (is_first || !(preference(known) >= preference(estimates[i]))) known = estimates[i];
  }
  return best;
}

constexpr double LEAST_LOG_ODDS = -4;  // others hardly end above the default threshold

// Estimates of one pose.
struct DistinctPose {
  std::size_t best;  // the most probable one
  std::vector<std::size_t> others;
};

// The indices of probable estimates, most probable first.
std::vector<std::size_t> probable(std::span<const PoseEstimate> estimates) {
  const auto log_odds = [&](std::size_t i) { return estimates[i].classification.pooled_log_odds; };
  std::vector<std::size_t> indices(estimates.size());
  std::iota(indices.begin(), indices.end(), 0);
  std::erase_if(indices, [&](std::size_t i) { return !(log_odds(i) >= LEAST_LOG_ODDS); });
  std::ranges::stable_sort(indices, std::greater{}, log_odds);
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
                  const RefineOptions& options) {
  const std::vector<DistinctPose> poses = distinct(scene, estimates, probable(estimates));
  std::vector<PoseEstimate> hopping;
  for (const DistinctPose& pose : poses) hopping.push_back(estimates[pose.best]);
  const std::vector<std::size_t> moved = hop_basins(scene, hopping, options.edge_icp);
  if (moved.empty()) return;
  std::vector<PoseEstimate> ends;
  for (const std::size_t i : moved) ends.push_back(hopping[i]);
  measure(scene, ends, options, options.d2co);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const DistinctPose& pose = poses[moved[k]];
    estimates[pose.best] = ends[k];
    for (const std::size_t other : pose.others) estimates[other] = ends[k];
  }
}

namespace {

// The steps of the last stage need not become as small as its own limit: that would cost more
// iterations than the pose is worth.
void set_converged(std::span<PoseEstimate> estimates) {
  for (PoseEstimate& estimate : estimates)
    if (estimate.convergence == Convergence::IterationLimit &&
        estimate.last_step_px < thresholds::CONVERGED_PX)
      estimate.convergence = Convergence::Converged;
}

std::vector<PoseEstimate> refine_batch(const Scene& scene, std::span<const ObjectPose> starts,
                                       const RefineOptions& options) {
  const bool searched = options.search.rotation_rad > 0 && !scene.is_time_over();
  const SearchResult found = searched ? search(scene, starts, options) : without_search(starts);
  D2coOptions d2co = options.d2co;
  // Where only the time forbids a search, the round is left out: it would not iterate.
  if (options.search.rotation_rad == 0) d2co.rounds.insert(d2co.rounds.begin(), options.unsearched);
  std::vector<PoseEstimate> estimates = register_poses(scene, found.poses, d2co);
  if (options.use_edge_icp && !scene.is_time_over()) edge_icp(scene, estimates, options.edge_icp);
  measure(scene, estimates, options, options.d2co);
  if (options.use_edge_icp && scene.views.size() == 1 && !scene.is_time_over())
    hop_probable(scene, estimates, options);
  set_converged(estimates);
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
