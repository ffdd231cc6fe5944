#include "host/register/d2co_ceres.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

#include "host/register/lm_state.h"
#include "host/register/point_cost.h"
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
  std::unique_ptr<ceres::LossFunction> loss;
  ceres::Problem problem{lent_loss()};
  PoseParameters pose;

  RoundProblem(const Se3& start, const PoseLoss& chosen)
      : loss(make_loss(chosen)), pose(to_parameters(start)) {
    problem.AddParameterBlock(pose.data(), 7, new Se3Manifold);
  }
  static ceres::Problem::Options lent_loss() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }
};

void add_visible_points(RoundProblem& round, const EdgeModel& model, const HostView& view,
                        Backend& backend, const VisibilityOptions& visibility, int most) {
  const Se3& camera_from_world = view.view.camera_from_world;
  const ObjectPose pose{0, from_parameters(round.pose.data())};
  const std::vector<ModelPoint> visible =
      visible_in_views({{&model, 1}, {&view.view, 1}, backend}, {&pose, 1}, visibility)(0, 0)
          .points;
  const std::size_t kept = most > 0 ? std::min(visible.size(), std::size_t(most)) : visible.size();
  for (std::size_t i = 0; i < kept; ++i)
    round.problem.AddResidualBlock(
        new PointCost(view.tensor_view(), camera_from_world, visible[i * visible.size() / kept]),
        round.loss.get(), round.pose.data());
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
WorldSystem system_at_solution(RoundProblem& round) {
  ceres::Problem::EvaluateOptions bare;
  bare.apply_loss_function = false;
  std::vector<double> residuals;
  ceres::CRSMatrix jacobian;
  WorldSystem system;
  if (!round.problem.Evaluate(bare, nullptr, &residuals, nullptr, &jacobian)) return system;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const Eigen::Map<const Vector6d> j(&jacobian.values[6 * i]);
    double rho[3];
    round.loss->Evaluate(residuals[i] * residuals[i], rho);
    system.hessian += rho[1] * j * j.transpose();
    system.gradient += rho[1] * residuals[i] * j;
    system.cost += 0.5 * rho[0];
    system.residual_sum += residuals[i];
    system.weight_sum += rho[1];
    system.points += 1;
  }
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
  const EdgeModel& model = scene.models[std::size_t(result.object)];
  RoundProblem at_pose(result.world_from_object, {round.loss, round.scale_px});
  for (const HostView& view : views)
    add_visible_points(at_pose, model, view, scene.backend, options.visibility, round.max_points);
  if (at_pose.problem.NumResiduals() == 0) {
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
