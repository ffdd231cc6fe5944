#include "host/register/refine.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/error.h"

namespace edgescout {

namespace {

// The start itself first, then turned in its place about the axes and the diagonals of the first
// view's camera frame.
std::vector<ObjectPose> spread(const ObjectPose& start, const EdgeModel& model,
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
  return (a * model.center_m - b * model.center_m).norm() < 0.03 * model.mesh.diameter_m &&
         angle_between_rad(a, b) < 0.06;
}

std::vector<RegisterView> coarse_views(std::span<const RegisterView> views) {
  std::vector<RegisterView> coarse(views.begin(), views.end());
  for (RegisterView& view : coarse)
    if (view.coarse) view.view = view.coarse;
  return coarse;
}

// For each hypothesis the different poses its search ended in, highest log-odds first; `owner` says
// whose they are.
struct Searched {
  std::vector<ObjectPose> poses;
  std::vector<std::size_t> owner;
};

Searched search(std::span<const EdgeModel> models, std::span<const ObjectPose> hypotheses,
                std::span<const RegisterView> views, Backend& backend,
                const RefineOptions& options) {
  std::vector<ObjectPose> starts;
  for (const ObjectPose& hypothesis : hypotheses)
    for (const ObjectPose& start : spread(hypothesis, models[hypothesis.object],
                                          views[0].camera_from_world, options.search.rotation_rad))
      starts.push_back(start);
  const std::size_t turned = starts.size();
  std::vector<ObjectPose> poses = object_poses_of(
      starts, register_poses(models, starts, coarse_views(views), backend, options.search.coarse));
  // Each start as it was, too: what fits already may be led away by the coarse look.
  poses.insert(poses.end(), hypotheses.begin(), hypotheses.end());
  const std::vector<PoseFeatures> features =
      pose_features(models, poses, views, backend, options.score, options.search.coarse.visibility);
  Searched found;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    const std::size_t of_one = turned / hypotheses.size();
    std::vector<std::size_t> order(of_one);
    std::iota(order.begin(), order.end(), h * of_one);
    order.push_back(turned + h);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return log_odds(features[a]) > log_odds(features[b]);
    });
    const std::size_t first = found.poses.size();
    for (std::size_t i : order) {
      if (int(found.poses.size() - first) >= options.search.num_kept) break;
      const bool known =
          std::any_of(found.poses.begin() + first, found.poses.end(), [&](const ObjectPose& other) {
            return same_pose(other.world_from_object, poses[i].world_from_object,
                             models[poses[i].object]);
          });
      if (known) continue;
      found.poses.push_back(poses[i]);
      found.owner.push_back(h);
    }
  }
  return found;
}

std::vector<Refined> refine_together(std::span<const EdgeModel> models,
                                     std::span<const ObjectPose> hypotheses,
                                     std::span<const RegisterView> views, Backend& backend,
                                     const RefineOptions& options) {
  Searched found;
  if (options.search.rotation_rad > 0) {
    found = search(models, hypotheses, views, backend, options);
  } else {
    found.poses.assign(hypotheses.begin(), hypotheses.end());
    for (std::size_t h = 0; h < hypotheses.size(); ++h) found.owner.push_back(h);
  }
  D2coOptions d2co = options.d2co;
  if (options.search.rotation_rad == 0) d2co.rounds.insert(d2co.rounds.begin(), options.unsearched);
  std::vector<Registration> registrations =
      register_poses(models, found.poses, views, backend, d2co);
  if (options.use_edge_icp)
    edge_icp(models, found.poses, views, backend, options.edge_icp_options, registrations);
  const std::vector<PoseFeatures> by_view =
      pose_features_by_view(models, object_poses_of(found.poses, registrations), views, backend,
                            options.score, options.d2co.visibility);
  std::vector<Refined> results(hypotheses.size());
  std::vector<bool> filled(hypotheses.size(), false);
  for (std::size_t i = 0; i < found.poses.size(); ++i) {
    const std::size_t h = found.owner[i];
    const std::span<const PoseFeatures> of_pose(by_view.data() + i * views.size(), views.size());
    const PoseFeatures features = pool_over_views(of_pose);
    if (filled[h] && log_odds(results[h].features) >= log_odds(features)) continue;
    results[h] = {registrations[i], features, {of_pose.begin(), of_pose.end()}};
    filled[h] = true;
  }
  return results;
}

}  // namespace

D2coOptions SearchOptions::coarse_defaults() {
  D2coOptions options;
  options.rounds = {{LOSS_GEMAN_MCCLURE, 20, 8, 200}, {LOSS_GEMAN_MCCLURE, 6, 8, 250}};
  options.visibility.depth_map_size_px = 96;
  return options;
}

D2coOptions RefineOptions::full_defaults() {
  D2coOptions options;
  options.rounds = {{LOSS_GEMAN_MCCLURE, 12, 8, 300},
                    {LOSS_GEMAN_MCCLURE, 5, 8, 500},
                    {LOSS_GEMAN_MCCLURE, 2, 8, 0}};
  return options;
}

void RefineOptions::validate() const {
  search.coarse.validate();
  d2co.validate();
  edge_icp_options.validate();
  if (!(search.rotation_rad >= 0 && search.rotation_rad <= 1))
    throw InputError("options", "register.search_rotation", std::to_string(search.rotation_rad),
                     "an angle in [0, 1] rad");
  if (at_once < 1)
    throw InputError("options", "register.at_once", std::to_string(at_once), "at least 1");
  if (search.num_kept < 1 || search.num_kept > 15)
    throw InputError("options", "register.num_kept", std::to_string(search.num_kept),
                     "a number in [1, 15]");
}

std::vector<Refined> refine_poses(std::span<const EdgeModel> models,
                                  std::span<const ObjectPose> hypotheses,
                                  std::span<const RegisterView> views, Backend& backend,
                                  const RefineOptions& options) {
  options.validate();
  check(!views.empty(), "refine_poses: at least one view");
  const std::size_t at_once = std::max<std::size_t>(1, std::size_t(options.at_once) / views.size());
  std::vector<Refined> results;
  for (std::size_t first = 0; first < hypotheses.size(); first += at_once) {
    std::vector<Refined> block = refine_together(
        models, hypotheses.subspan(first, std::min(at_once, hypotheses.size() - first)), views,
        backend, options);
    std::ranges::move(block, std::back_inserter(results));
  }
  return results;
}

}  // namespace edgescout
