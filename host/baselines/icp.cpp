#include "host/baselines/icp.h"

#include <cmath>

#include "host/baselines/point_sums.h"
#include "host/core/pose_steps.h"

namespace edgescout {

Pairs associate_all(std::span<const ObjectView> views,
                    std::span<const std::vector<ModelPoint>> points, const Se3& world_from_object,
                    const Associate& associate) {
  Pairs pairs;
  for (const std::vector<ModelPoint>& list : points) pairs.emplace_back(list.size(), nullptr);
  sum_over_points(views, points, world_from_object,
                  [&](WorldSystem&, std::size_t v, std::size_t i, const PosedPoint<double>&,
                      const ProjectedEdge<double>& at) {
                    pairs[v][i] = associate(v, at.u, at.v, orientation(at.dx, at.dy));
                  });
  return pairs;
}

WorldSystem pair_system(std::span<const ObjectView> views,
                        std::span<const std::vector<ModelPoint>> points, const Pairs& pairs,
                        const Se3& world_from_object, double loss_scale_px) {
  return sum_over_points(
      views, points, world_from_object,
      [&](WorldSystem& sum, std::size_t v, std::size_t i, const PosedPoint<double>& posed,
          const ProjectedEdge<double>& at) {
        const EdgePoint* edge = pairs[v][i];
        if (!edge) return;
        const Intrinsics& k = views[v].tensor->intrinsics;
        const double dx = at.u - edge->x_px, dy = at.v - edge->y_px, distance = std::hypot(dx, dy);
        const Weighted loss = huber(distance, loss_scale_px);
        add_residual(sum, dx, loss.weight, loss.rho, image_motion(1, 0, posed, k));
        add_residual(sum, dy, loss.weight, 0, image_motion(0, 1, posed, k));
        sum.residual_sum += distance;
        sum.weight_sum += loss.weight;
        sum.points += 1;
      });
}

LmState iterate_closest_points(const Se3& start, std::span<const ObjectView> views,
                               std::span<const std::vector<ModelPoint>> points,
                               const Associate& associate, const BaselineOptions& options) {
  LmState state;
  state.pose = start;
  for (int outer = 0; outer < options.outer_iterations && state.active; ++outer) {
    const Se3 before = state.pose;
    const Pairs pairs = associate_all(views, points, before, associate);
    initialize(state, pair_system(views, points, pairs, state.pose, options.loss_scale_px));
    // Gauss-Newton: every step is taken. The damping only stops motion in directions that no pair
    // determines.
    state.damping = 1e-6;
    for (int inner = 0; inner < options.inner_iterations && state.active; ++inner) {
      compute_step(state);
      state.pose = state.trial;
      initialize(state, pair_system(views, points, pairs, state.pose, options.loss_scale_px));
      if (is_small(state.step, options.min_step_m, options.min_step_rad)) break;
    }
    ++state.iterations;
    if (state.active &&
        is_small(local_coordinates(before, state.pose), options.min_step_m, options.min_step_rad))
      state.active = false, state.convergence = Convergence::Converged;
  }
  return state;
}

}  // namespace edgescout
