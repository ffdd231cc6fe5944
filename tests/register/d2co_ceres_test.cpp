// Both solvers reach the same minimum.
#include "host/register/d2co_ceres.h"

#include <gtest/gtest.h>

#include "host/core/pose_steps.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

struct Pair {
  PoseEstimate batched, ceres;
};

Pair solve_both(const PartScene& scene, Backend& backend, const D2coOptions& options) {
  D2coOptions with_ceres = options;
  with_ceres.solver = Solver::Ceres;
  const std::span starts(&scene.start, 1);
  return {register_poses(scene.on(backend), starts, options)[0],
          register_poses(scene.on(backend), starts, with_ceres)[0]};
}

// Compares the cost per point: points of the last round differ where the rounds before ended at
// slightly different poses.
double cost_ratio(const Pair& pair) {
  return pair.batched.cost_px2 / pair.batched.points * pair.ceres.points / pair.ceres.cost_px2;
}

TEST(D2coCeres, ReachesTheBatchedMinimumInThreeViews) {
  Random random = test_random();
  const std::unique_ptr<Backend> backend = make_cpu_backend(2);
  for (const char* part : {"l_bracket", "bearing_block", "u_channel"}) {
    const PartScene scene(part, 3, random, *backend);
    const Pair pair = solve_both(scene, *backend, {});
    EXPECT_NEAR(cost_ratio(pair), 1, 0.01) << part;
    EXPECT_LT(distance_between_m(pair.batched.world_from_object, pair.ceres.world_from_object),
              5e-5)
        << part;
    EXPECT_LT(angle_between_rad(pair.batched.world_from_object, pair.ceres.world_from_object), 3e-3)
        << part;
    const Eigen::ArrayXd ratio =
        pair.batched.covariance.diagonal().array() / pair.ceres.covariance.diagonal().array();
    EXPECT_LT((ratio - 1).abs().maxCoeff(), 0.3) << part << " " << ratio.transpose();
  }
}

// In one view the kinks of the distance transform stop the solvers at slightly different depths.
// One round with Huber's loss on an unsmoothed tensor has fewer kinks.
TEST(D2coCeres, ReachesTheBatchedMinimumInOneView) {
  Random random = test_random();
  const std::unique_ptr<Backend> backend = make_cpu_backend(2);
  TensorOptions unsmoothed;
  unsmoothed.smoothing_variance = 0;
  for (const char* part : {"l_bracket", "bearing_block", "u_channel"}) {
    const PartScene scene(part, 1, random, *backend, unsmoothed);
    const Pair pair = solve_both(scene, *backend, one_round(LOSS_HUBER, 10, 200));
    const Eigen::Vector3d apart =
        scene.views[0].camera_from_world.rotation *
        (pair.batched.world_from_object.translation_m - pair.ceres.world_from_object.translation_m);
    EXPECT_NEAR(cost_ratio(pair), 1, 0.01) << part;
    EXPECT_LT(apart.head<2>().norm(), 1e-4) << part;
    EXPECT_LT(std::abs(apart.z()), 1e-3) << part;
    EXPECT_LT(angle_between_rad(pair.batched.world_from_object, pair.ceres.world_from_object), 3e-3)
        << part;
  }
}

// Without a step both solvers have the same system: cost, residuals and covariance agree to the
// kernel's precision.
TEST(D2coCeres, DescribesAPoseLikeTheBatchedSolver) {
  Random random = test_random();
  const std::unique_ptr<Backend> backend = make_cpu_backend(2);
  for (const std::uint32_t loss : {LOSS_HUBER, LOSS_GEMAN_MCCLURE})
    for (const int most : {0, 57}) {
      const PartScene scene("bearing_block", 2, random, *backend);
      D2coOptions stay = one_round(loss, 8, 1);
      stay.rounds[0].max_points = most;
      stay.min_step_m = stay.min_step_rad = 1e6;  // any step is small
      const PoseEstimate ceres =
          register_poses_ceres(scene.on(*backend), std::span(&scene.start, 1), stay)[0];
      EXPECT_EQ(ceres.convergence, Convergence::Converged);
      EXPECT_LT(distance_between_m(ceres.world_from_object, scene.start.world_from_object), 1e-12);
      const WorldSystem system =
          system_at(scene, scene.start.world_from_object, {loss, 8}, std::size_t(most), *backend);
      EXPECT_EQ(ceres.points, system.points);
      EXPECT_NEAR(ceres.cost_px2, system.cost, 1e-3 * system.cost);
      EXPECT_NEAR(ceres.mean_px, system.residual_sum / system.points, 1e-3 * ceres.mean_px);
      const Matrix6d expected =
          pose_covariance(system.hessian, 2 * system.cost / (system.weight_sum - 6));
      EXPECT_LT((ceres.covariance - expected).norm(), 0.02 * expected.norm());
    }
}

}  // namespace
}  // namespace edgescout
