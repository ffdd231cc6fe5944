#include "host/register/d2co_ceres.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

#include "host/core/pose_steps.h"
#include "host/core/thinned.h"
#include "host/register/depth_cost.h"
#include "host/register/depth_systems.h"
#include "host/register/lm_state.h"
#include "host/register/measured_depth.h"
#include "host/register/point_cost.h"
#include "host/register/points_in_image.h"
#include "host/register/se3_manifold.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// A view with the values of its tensor on the host.
struct HostView {
  ObjectView view;
  std::vector<std::uint16_t> values = view.tensor->tensor();
  TensorView tensor_view() const { return {values, view.tensor->shape, view.tensor->intrinsics}; }
};

std::vector<HostView> download(std::span<const ObjectView> views) {
  std::vector<HostView> host;
  for (const ObjectView& view : views) host.push_back({view});
  return host;
}

// One round of one pose. The loss is declared before the problem because it must outlive it.
struct RoundProblem {
  std::unique_ptr<ceres::LossFunction> loss, depth_loss;
  std::vector<ceres::ResidualBlockId> edges, surface;  // the residuals of their points
  ceres::Problem problem{lent_loss()};
  PoseParameters pose;

  RoundProblem(const Se3& start, const D2coRound& round)
      : loss(make_loss({round.loss, float(round.scale_px)})),
        depth_loss(make_loss({LOSS_GEMAN_MCCLURE, float(round.depth_sigmas)})),
        pose(to_parameters(start)) {
    problem.AddParameterBlock(pose.data(), 7, new Se3Manifold);
  }
  static ceres::Problem::Options lent_loss() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }
};

void add_edges(RoundProblem& round, const HostView& view, std::span<const ModelPoint> points) {
  for (const ModelPoint& point : points)
    round.edges.push_back(round.problem.AddResidualBlock(
        new PointCost(view.tensor_view(), view.view.camera_from_world, point), round.loss.get(),
        round.pose.data()));
}

void add_surface(RoundProblem& round, const ObjectView& view, std::span<const SurfacePoint> surface,
                 const PoseDepthOptions& options) {
  if (!view.depth) return;
  const DepthImage& depth = view.depth->image;
  const DepthView measured{depth.z_m, depth.width, depth.height, intrinsics_of(view.camera)};
  for (const SurfacePoint& sample : surface)
    round.surface.push_back(round.problem.AddResidualBlock(
        new DepthCost(measured, view.camera_from_world, sample, options), round.depth_loss.get(),
        round.pose.data()));
}

void add_visible_points(RoundProblem& at_pose, const Scene& scene, const HostView& view,
                        const ObjectPose& pose, const D2coRound& round,
                        const VisibilityOptions& visibility) {
  VisibleInView visible = visible_in_views({scene.models, {&view.view, 1}, scene.backend},
                                           {&pose, 1}, visibility)(0, 0);
  remove_outside(visible.points, scene.models[std::size_t(pose.object)], view.view.camera,
                 view.view.camera_from_world * pose.world_from_object);
  add_edges(at_pose, view, thinned(visible.points, round.max_points));
  add_surface(at_pose, view.view, thinned(visible.surface, round.max_surface_points),
              pose_depth_options(scene, REGISTRATION_BAND));
}

ceres::Solver::Options solver_options(const D2coRound& round, const D2coOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.logging_type = ceres::SILENT;
  solver.max_num_iterations = round.iterations;
  // Ceres compares the length of the step in the 7 parameters with the length of the parameters.
  // The latter is at least 1, the quaternion's. A rotation counts half.
  solver.parameter_tolerance = std::min(options.min_step_m, 0.5 * options.min_step_rad);
  solver.function_tolerance = 0;
  solver.gradient_tolerance = 0;
  return solver;
}

// Ends the iterations where the scene's limit is over.
class EndsInTime : public ceres::IterationCallback {
 public:
  explicit EndsInTime(const Scene& scene) : scene_(scene) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return scene_.is_time_over() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const Scene& scene_;
};

Convergence convergence_of(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      return Convergence::Converged;
    case ceres::NO_CONVERGENCE:
      return Convergence::IterationLimit;
    case ceres::USER_SUCCESS:
      return Convergence::OutOfTime;
    default:
      return Convergence::NoDecrease;
  }
}

// The weighted system at the solution, in the world's tangent. Empty where Ceres could not evaluate
// all points.
WorldSystem system_of(RoundProblem& round, const std::vector<ceres::ResidualBlockId>& blocks,
                      const ceres::LossFunction& loss) {
  ceres::Problem::EvaluateOptions bare;
  bare.apply_loss_function = false;
  bare.residual_blocks = blocks;
  std::vector<double> residuals;
  ceres::CRSMatrix jacobian;
  WorldSystem system;
  if (blocks.empty() || !round.problem.Evaluate(bare, nullptr, &residuals, nullptr, &jacobian))
    return system;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const Eigen::Map<const Vector6d> j(&jacobian.values[6 * i]);
    double rho[3];
    loss.Evaluate(residuals[i] * residuals[i], rho);
    system.hessian += rho[1] * j * j.transpose();
    system.gradient += rho[1] * residuals[i] * j;
    system.cost += 0.5 * rho[0];
    system.residual_sum += residuals[i];
    system.weight_sum += rho[1];
    system.points += 1;
  }
  return system;
}

// Of the surface only what determines the pose counts: points and cost are those of the edges.
WorldSystem system_at_solution(RoundProblem& round) {
  WorldSystem system = system_of(round, round.edges, *round.loss);
  const WorldSystem surface = system_of(round, round.surface, *round.depth_loss);
  system.hessian += surface.hessian;
  system.gradient += surface.gradient;
  return system;
}

void fill(PoseEstimate& result, const WorldSystem& system) {
  result.cost_px2 = system.cost;
  result.points = static_cast<int>(system.points);
  result.mean_px = system.points > 0 ? system.residual_sum / system.points : 0;
  result.covariance =
      pose_covariance(system.hessian, 2 * system.cost / std::max(1.0, system.weight_sum - 6));
}

void solve_round(PoseEstimate& result, const Scene& scene, std::span<const HostView> views,
                 const D2coRound& round, const D2coOptions& options) {
  RoundProblem at_pose(result.world_from_object, round);
  for (const HostView& view : views)
    add_visible_points(at_pose, scene, view, result, round, options.visibility);
  if (at_pose.edges.empty()) {
    result.convergence = Convergence::NoPoints;
    fill(result, {});
    return;
  }
  ceres::Solver::Summary summary;
  EndsInTime ends_in_time(scene);
  ceres::Solver::Options solver = solver_options(round, options);
  solver.callbacks.push_back(&ends_in_time);
  ceres::Solve(solver, &at_pose.problem, &summary);
  result.world_from_object = from_parameters(at_pose.pose.data());
  // The first entry is the start itself. There is none where the start could not be evaluated.
  result.iterations += std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  result.convergence = convergence_of(summary);
  fill(result, system_at_solution(at_pose));
}

}  // namespace

std::vector<PoseEstimate> register_poses_ceres(const Scene& scene,
                                               std::span<const ObjectPose> starts,
                                               const D2coOptions& options) {
  options.validate();
  check_problem(starts, scene.models.size(), scene.views);
  const std::vector<HostView> views = download(scene.views);
  std::vector<PoseEstimate> results;
  for (const ObjectPose& start : starts) {
    PoseEstimate& result = results.emplace_back();
    static_cast<ObjectPose&>(result) = start;
    for (const D2coRound& round : options.rounds) solve_round(result, scene, views, round, options);
  }
  return results;
}

}  // namespace edgescout
