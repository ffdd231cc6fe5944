#include "host/register/d2co.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "host/register/d2co_ceres.h"
#include "host/register/depth_systems.h"
#include "host/register/lm_state.h"
#include "host/register/points_in_image.h"
#include "host/register/template_points.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// Calls body(p) for the poses on all threads. They do not know of each other.
template <typename Body>
void for_poses(std::size_t count, ThreadPool& pool, const Body& body) {
  for_each_in_chunks(pool, count, 64, body);
}

class Evaluator {
 public:
  Evaluator(VisiblePoints visible, const Scene& scene, const D2coRound& round)
      : ranges_(std::move(visible.edges.ranges)),
        points_(scene.backend.make_pose_points(std::move(visible.edges.points))),
        scene_(scene),
        loss_{round.loss, float(round.scale_px)} {
    if (scene.has_depth()) depth_.emplace(scene, std::move(visible.surface), round.depth_sigmas);
    for (const ObjectView& view : scene.views) tensors_.push_back(view.tensor);
  }

  // Systems at the trial poses of the active states, in the states' order; those of inactive states
  // mean nothing. They hold until the next call.
  std::span<const WorldSystem> at_trials(std::span<const LmState> states) {
    const std::span<const ObjectView> views = scene_.views;
    std::vector<std::size_t> active;
    for (std::size_t p = 0; p < states.size(); ++p)
      if (states[p].active) active.push_back(p);
    problems_.resize(active.size() * views.size());
    results_.resize(problems_.size());
    for_poses(active.size(), scene_.backend.threads(), [&](std::size_t i) {
      for (std::size_t v = 0; v < views.size(); ++v) {
        const PointRange range = ranges_(active[i], v);
        problems_[i * views.size() + v] = {
            to_pose(views[v].camera_from_world * states[active[i]].trial), range.first, range.count,
            static_cast<std::uint32_t>(v)};
      }
    });
    scene_.backend.pose_normal_equations(tensors_, *points_, problems_, loss_, results_);
    systems_.resize(states.size());
    for_poses(active.size(), scene_.backend.threads(), [&](std::size_t i) {
      WorldSystem& system = systems_[active[i]];
      system = {};
      for (std::size_t v = 0; v < views.size(); ++v)
        add_view(system, results_[i * views.size() + v], views[v].camera_from_world);
    });
    if (depth_) depth_->add_at_trials(states, systems_);
    return systems_;
  }

 private:
  Grid<PointRange> ranges_;
  PosePointsHandle points_;
  const Scene& scene_;
  PoseLoss loss_;
  std::optional<DepthSystems> depth_;
  std::vector<ViewHandle> tensors_;
  std::vector<PoseProblem> problems_;
  std::vector<NormalEquations> results_;
  std::vector<WorldSystem> systems_;
};

void check_ranges(const Grid<PointRange>& ranges, std::size_t poses, const Scene& scene) {
  check(ranges.rows() == poses && ranges.columns() == scene.views.size(),
        "register_points: one range of points a pose and view");
}

void end_early(std::span<LmState> states) {
  for (LmState& state : states) state.convergence = Convergence::OutOfTime;
}

void run_round(std::span<LmState> states, Evaluator& evaluator, const D2coRound& round,
               const D2coOptions& options, const Scene& scene) {
  ThreadPool& pool = scene.backend.threads();
  for (LmState& state : states) restart(state);
  std::span<const WorldSystem> systems = evaluator.at_trials(states);
  for_poses(states.size(), pool, [&](std::size_t p) { initialize(states[p], systems[p]); });
  for (int i = 0; i < round.iterations; ++i) {
    if (std::ranges::none_of(states, [](const LmState& state) { return state.active; })) return;
    if (scene.is_time_over()) return;
    for_poses(states.size(), pool, [&](std::size_t p) {
      if (states[p].active) compute_step(states[p]);
    });
    systems = evaluator.at_trials(states);
    for_poses(states.size(), pool, [&](std::size_t p) {
      if (states[p].active)
        accept_step(states[p], systems[p], options.min_step_m, options.min_step_rad);
    });
  }
}

}  // namespace

void check_problem(std::span<const ObjectPose> starts, std::size_t models,
                   std::span<const ObjectView> views) {
  check(!views.empty(), "register_poses: at least one view");
  for (const ObjectView& view : views)
    check(is_finite(view.camera_from_world), "register_poses: a view whose pose is not finite");
  for (const ObjectPose& start : starts) {
    check(start.object >= 0 && static_cast<std::size_t>(start.object) < models,
          "register_poses: no such model");
    check(is_finite(start.world_from_object), "register_poses: a start that is not finite");
  }
}

std::vector<PoseEstimate> register_poses(const Scene& scene, std::span<const ObjectPose> starts,
                                         const D2coOptions& options) {
  if (options.solver == Solver::Ceres) return register_poses_ceres(scene, starts, options);
  check_problem(starts, scene.models.size(), scene.views);
  const auto find_visible = [&](std::span<const ObjectPose> poses, const D2coRound& round) {
    Grid<VisibleInView> visible = visible_in_views(scene, poses, options.visibility);
    ThreadPool& threads = scene.backend.threads();
    for_poses(poses.size(), threads, [&](std::size_t p) {
      for (std::size_t v = 0; v < scene.views.size(); ++v)
        remove_outside(visible(p, v).points, scene.models[std::size_t(poses[p].object)],
                       scene.views[v].camera,
                       scene.views[v].camera_from_world * poses[p].world_from_object);
    });
    return VisiblePoints{
        points_of(visible, &VisibleInView::points, round.max_points, threads),
        points_of(visible, &VisibleInView::surface, round.max_surface_points, threads)};
  };
  return register_points(scene, starts, find_visible, options);
}

std::vector<PoseEstimate> register_on_templates(const Scene& scene, const TemplateSet& set,
                                                std::span<const ObjectPose> starts,
                                                const D2coOptions& options) {
  const auto look_up = [&](std::span<const ObjectPose> poses, const D2coRound& round) {
    const WantedPoints wanted{round.max_points, round.max_surface_points, true};
    return template_points(set, scene.views, poses, wanted, scene.backend).visible;
  };
  return register_points(scene, starts, look_up, options);
}

std::vector<PoseEstimate> register_points(const Scene& scene, std::span<const ObjectPose> starts,
                                          const FindPoints& find_points,
                                          const D2coOptions& options) {
  options.validate();
  check_problem(starts, std::numeric_limits<std::size_t>::max(), scene.views);
  std::vector<ObjectPose> poses(starts.begin(), starts.end());
  std::vector<LmState> states(starts.size());
  ThreadPool& pool = scene.backend.threads();
  for (std::size_t p = 0; p < starts.size(); ++p) states[p].pose = starts[p].world_from_object;
  for (const D2coRound& round : options.rounds) {
    for (std::size_t p = 0; p < poses.size(); ++p) poses[p].world_from_object = states[p].pose;
    VisiblePoints visible = find_points(poses, round);
    check_ranges(visible.edges.ranges, poses.size(), scene);
    check_ranges(visible.surface.ranges, poses.size(), scene);
    Evaluator evaluator(std::move(visible), scene, round);
    run_round(states, evaluator, round, options, scene);
    if (!scene.is_time_over()) continue;
    end_early(states);
    break;
  }
  std::vector<PoseEstimate> estimates(starts.size());
  for_poses(starts.size(), pool,
            [&](std::size_t p) { estimates[p] = estimate_of(states[p], starts[p].object); });
  return estimates;
}

}  // namespace edgescout
