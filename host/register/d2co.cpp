#include "host/register/d2co.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "host/core/option_bounds.h"
#include "host/register/lm_state.h"
#include "host/register/register_points.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Visible points of every (hypothesis, view), in one list.
struct PointSets {
  std::vector<ModelPoint> points;
  std::vector<std::uint32_t> first, count;  // [hypothesis * views + view]
};

PointSets collect_points(std::span<const ObjectPose> hypotheses, std::span<const LmState> states,
                         const PointsInViews& points, std::size_t views, int most) {
  std::vector<ObjectPose> poses;
  for (std::size_t h = 0; h < hypotheses.size(); ++h)
    poses.push_back({hypotheses[h].object, states[h].pose});
  const std::vector<std::vector<ModelPoint>> in_views = points(poses);
  check(in_views.size() == poses.size() * views,
        "register_points: one list of points a pose and view");
  PointSets sets;
  for (const std::vector<ModelPoint>& seen : in_views) {
    const std::vector<ModelPoint> kept = thinned(seen, most);
    sets.first.push_back(static_cast<std::uint32_t>(sets.points.size()));
    sets.count.push_back(static_cast<std::uint32_t>(kept.size()));
    sets.points.insert(sets.points.end(), kept.begin(), kept.end());
  }
  return sets;
}

class Evaluator {
 public:
  Evaluator(const PointSets& sets, std::span<const RegisterView> views, Backend& backend,
            const PoseLoss& loss)
      : sets_(sets), views_(views), backend_(backend), loss_(loss) {
    for (const RegisterView& view : views) handles_.push_back(view.view);
  }

  // Systems at the trial poses of the active states, in the states' order; inactive ones stay
  // empty.
  std::vector<WorldSystem> at_trials(std::span<const LmState> states) {
    problems_.clear();
    for (std::size_t h = 0; h < states.size(); ++h)
      for (std::size_t v = 0; states[h].active && v < views_.size(); ++v) {
        const std::size_t slot = h * views_.size() + v;
        problems_.push_back({to_pose(views_[v].camera_from_world * states[h].trial),
                             sets_.first[slot], sets_.count[slot], static_cast<std::uint32_t>(v)});
      }
    results_.resize(problems_.size());
    backend_.pose_normal_equations(handles_, sets_.points, problems_, loss_, results_);
    std::vector<WorldSystem> systems(states.size());
    std::size_t next = 0;
    for (std::size_t h = 0; h < states.size(); ++h)
      for (std::size_t v = 0; states[h].active && v < views_.size(); ++v)
        add_view(systems[h], results_[next++], views_[v].camera_from_world);
    return systems;
  }

 private:
  const PointSets& sets_;
  std::span<const RegisterView> views_;
  Backend& backend_;
  PoseLoss loss_;
  std::vector<ViewHandle> handles_;
  std::vector<PoseProblem> problems_;
  std::vector<NormalEquations> results_;
};

void run_round(std::span<LmState> states, Evaluator& evaluator, const D2coRound& round,
               const D2coOptions& options) {
  for (LmState& state : states) restart(state);
  std::vector<WorldSystem> systems = evaluator.at_trials(states);
  for (std::size_t h = 0; h < states.size(); ++h) initialize(states[h], systems[h]);
  for (int i = 0; i < round.iterations; ++i) {
    if (std::ranges::none_of(states, [](const LmState& t) { return t.active; })) return;
    for (LmState& state : states)
      if (state.active) compute_step(state);
    systems = evaluator.at_trials(states);
    for (std::size_t h = 0; h < states.size(); ++h)
      if (states[h].active)
        accept_step(states[h], systems[h], options.min_step_m, options.min_step_rad);
  }
}

}  // namespace

std::vector<ModelPoint> thinned(const std::vector<ModelPoint>& points, int most) {
  if (most <= 0 || int(points.size()) <= most) return points;
  std::vector<ModelPoint> kept(most);
  for (int i = 0; i < most; ++i) kept[i] = points[std::size_t(i) * points.size() / most];
  return kept;
}

Matrix6d pose_covariance(const Matrix6d& hessian, double residual_variance) {
  const Eigen::LDLT<Matrix6d> factor(hessian);
  if (factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0)
    return residual_variance * factor.solve(Matrix6d::Identity());
  // Not a product with the identity: zero times infinity is no number.
  Matrix6d unknown = Matrix6d::Zero();
  unknown.diagonal().setConstant(std::numeric_limits<double>::infinity());
  return unknown;
}

std::vector<D2coRound> D2coOptions::default_rounds() {
  return {{LOSS_GEMAN_MCCLURE, 30, 12, 400},
          {LOSS_GEMAN_MCCLURE, 15, 12, 500},
          {LOSS_GEMAN_MCCLURE, 8, 12, 700},
          {LOSS_GEMAN_MCCLURE, 4, 12, 0},
          {LOSS_GEMAN_MCCLURE, 2, 12, 0}};
}

void D2coOptions::validate() const {
  const OptionBounds in("register");
  if (rounds.empty()) throw InputError("options", "register.rounds", "none", "at least one round");
  for (const D2coRound& round : rounds) {
    if (round.loss != LOSS_HUBER && round.loss != LOSS_GEMAN_MCCLURE)
      throw InputError("options", "register.loss", std::to_string(round.loss),
                       "Huber's or Geman and McClure's");
    in("scale", round.scale_px, 1e-3, 1000);
    in("iterations", round.iterations, 1, 1000);
    in("max_points", round.max_points, 0, 1e6);
  }
  in("min_step_m", min_step_m, 0, 1e9);
  in("min_step_rad", min_step_rad, 0, 1e9);
  visibility.validate();
}

std::string to_string(Convergence reason) {
  switch (reason) {
    case Convergence::SmallStep:
      return "small step";
    case Convergence::NoDecrease:
      return "no decrease";
    case Convergence::IterationLimit:
      return "iteration limit";
    case Convergence::NoPoints:
      return "no visible points";
  }
  throw LogicError("unknown convergence reason");
}

std::vector<ObjectPose> object_poses_of(std::span<const ObjectPose> starts,
                                        std::span<const Registration> registrations) {
  std::vector<ObjectPose> poses;
  for (std::size_t i = 0; i < starts.size(); ++i)
    poses.push_back({starts[i].object, registrations[i].world_from_object});
  return poses;
}

std::vector<Registration> register_poses(std::span<const EdgeModel> models,
                                         std::span<const ObjectPose> hypotheses,
                                         std::span<const RegisterView> views, Backend& backend,
                                         const D2coOptions& options) {
  check_problem(hypotheses, models.size(), views);
  const auto drawn = [&](std::span<const ObjectPose> poses) {
    std::vector<std::vector<ModelPoint>> points;
    for (VisibleInView& seen : visible_in_views(models, poses, views, backend, options.visibility))
      points.push_back(std::move(seen.points));
    return points;
  };
  return register_points(hypotheses, views, drawn, backend, options);
}

std::vector<Registration> register_points(std::span<const ObjectPose> hypotheses,
                                          std::span<const RegisterView> views,
                                          const PointsInViews& points, Backend& backend,
                                          const D2coOptions& options) {
  options.validate();
  check_problem(hypotheses, std::numeric_limits<std::size_t>::max(), views);
  std::vector<LmState> states(hypotheses.size());
  for (std::size_t h = 0; h < hypotheses.size(); ++h)
    states[h].pose = hypotheses[h].world_from_object;
  for (const D2coRound& round : options.rounds) {
    const PointSets sets =
        collect_points(hypotheses, states, points, views.size(), round.max_points);
    Evaluator evaluator(sets, views, backend, {round.loss, round.scale_px});
    run_round(states, evaluator, round, options);
  }
  std::vector<Registration> results;
  for (const LmState& state : states) results.push_back(registration_of(state));
  return results;
}

}  // namespace edgescout
