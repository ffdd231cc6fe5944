// Both solvers of D2CO: the poses that they recover, their covariance, and poses without visible
// points.
#include "host/register/d2co.h"

#include <gtest/gtest.h>

#include <limits>

#include "host/core/matrix6.h"
#include "kernels/error.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

class D2co : public ::testing::TestWithParam<Solver> {
 protected:
  std::vector<PoseEstimate> solve(const Scene& scene, std::span<const ObjectPose> starts,
                                  D2coOptions options = {}) {
    options.solver = GetParam();
    return register_poses(scene, starts, options);
  }
  PoseEstimate solve(const PartScene& scene, const D2coOptions& options = {}) {
    return solve(scene.on(*backend), std::span(&scene.start, 1), options)[0];
  }
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
};
INSTANTIATE_TEST_SUITE_P(Solvers, D2co, ::testing::Values(Solver::Batched, Solver::Ceres),
                         [](const auto& solver) { return to_string(solver.param); });

// A pixel is half a millimetre here.
TEST_P(D2co, RecoversAPartInThreeViews) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "bearing_block", "u_channel"}) {
    const PartScene scene(part, 3, random, *backend);
    const PoseEstimate found = solve(scene);
    EXPECT_LT(distance_between_m(found.world_from_object, scene.truth), 1.5e-4) << part;
    EXPECT_LT(angle_between_rad(found.world_from_object, scene.truth), 0.015) << part;
    EXPECT_GT(found.points, 300);
  }
}

// One view determines the position across the line of sight. It determines depth and tilt less
// well: near the truth the tensor's cost has other minima as deep as the truth's. The solver may
// end there, at a cost at most 2 % higher.
TEST_P(D2co, RecoversAPartInOneView) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "bearing_block", "u_channel"}) {
    const PartScene scene(part, 1, random, *backend);
    const PoseEstimate found = solve(scene);
    const Eigen::Vector3d error =
        scene.views[0].camera_from_world.rotation *
        (found.world_from_object.translation_m - scene.truth.translation_m);
    EXPECT_LT(error.head<2>().norm(), 6e-4) << part;
    EXPECT_LT(std::abs(error.z()), 1e-2) << part;
    EXPECT_LT(angle_between_rad(found.world_from_object, scene.truth), 0.05) << part;
    const D2coRound last = D2coOptions::default_rounds().back();
    const WorldSystem true_system =
        system_at(scene, scene.truth, {last.loss, last.scale_px}, 0, *backend);
    EXPECT_LT(found.cost_px2 / found.points, 1.02 * true_system.cost / true_system.points) << part;
  }
}

// Points that the image does not show would pull the part inwards and away from the camera.
TEST_P(D2co, RecoversAPartThatTheBorderCuts) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "bearing_block", "u_channel"}) {
    PartScene scene(part, 1, random, *backend);
    ObjectView& view = scene.views[0];
    view.camera.cx = 30;  // of the part's centre; its radius is some 70 px
    const std::vector<EdgePoint> edges = ideal_edges(
        part_model(part, 2e-4), view.camera, view.camera_from_world * scene.truth, *backend);
    view.tensor = backend->make_view(edges, view.camera.width, view.camera.height, {},
                                     intrinsics_of(view.camera), {});
    const PoseEstimate found = solve(scene);
    EXPECT_LT(distance_between_m(found.world_from_object, scene.truth), 5e-3) << part;
    EXPECT_LT(angle_between_rad(found.world_from_object, scene.truth), 0.05) << part;
  }
}

// The time is over when it is asked for the third time.
TEST_P(D2co, SaysThatTheTimeWasOver) {
  Random random = test_random();
  const PartScene part("l_bracket", 3, random, *backend);
  Scene scene = part.on(*backend);
  int asked = 0;
  TimeLimit limit;
  limit.cancelled = [&] { return ++asked >= 3; };
  scene.limit = &limit;
  EXPECT_EQ(solve(scene, std::span(&part.start, 1))[0].convergence, Convergence::OutOfTime);
  EXPECT_NE(solve(part).convergence, Convergence::OutOfTime);
  EXPECT_EQ(to_string(Convergence::OutOfTime), "out of time");
}

Eigen::Vector3d position_sigmas(const PoseEstimate& found, const Se3& camera_from_world) {
  const Eigen::Matrix3d r = camera_from_world.rotation.toRotationMatrix();
  return (r * found.covariance.topLeftCorner<3, 3>() * r.transpose()).diagonal().cwiseSqrt();
}

TEST_P(D2co, CovarianceIsPositiveAndLargestInDepth) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "bearing_block", "u_channel"}) {
    const PartScene scene(part, 1, random, *backend);
    const PoseEstimate found = solve(scene);
    ASSERT_TRUE(found.covariance.allFinite());
    EXPECT_LT((found.covariance - found.covariance.transpose()).norm(),
              1e-6 * found.covariance.norm());
    EXPECT_GT(eigenvectors(found.covariance).values.minCoeff(), 0);
    const Eigen::Vector3d sigma = position_sigmas(found, scene.views[0].camera_from_world);
    EXPECT_GT(sigma.z(), 3 * sigma.x()) << part;
    EXPECT_GT(sigma.z(), 3 * sigma.y()) << part;
  }
}

TEST_P(D2co, CovarianceShrinksWithViews) {
  Random random = test_random();
  PartScene scene("bearing_block", 3, random, *backend);
  std::vector<double> depth_sigma, volume;
  for (const std::size_t count : {3, 2, 1}) {
    scene.views.resize(count);
    const PoseEstimate found = solve(scene);
    depth_sigma.push_back(position_sigmas(found, scene.views[0].camera_from_world).z());
    volume.push_back(determinant(found.covariance));
  }
  EXPECT_LT(depth_sigma[0], depth_sigma[1]);
  EXPECT_LT(depth_sigma[1], 0.5 * depth_sigma[2]);
  EXPECT_LT(volume[0], volume[1]);
  EXPECT_LT(volume[1], volume[2]);
}

TEST_P(D2co, ReportsNoPointsBehindTheCamera) {
  Random random = test_random();
  PartScene scene("l_bracket", 1, random, *backend);
  const Se3 camera_from_world = scene.views[0].camera_from_world;
  scene.start.world_from_object = inverse(camera_from_world) * Se3{random.rotation(), {0, 0, -0.4}};
  const PoseEstimate found = solve(scene);
  EXPECT_EQ(found.convergence, Convergence::NoPoints);
  EXPECT_EQ(found.points, 0);
  EXPECT_EQ(found.mean_px, 0);
  EXPECT_EQ(found.cost_px2, 0);
  EXPECT_EQ(found.world_from_object.translation_m, scene.start.world_from_object.translation_m);
  EXPECT_FALSE(found.covariance.hasNaN());
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(found.covariance(i, i), std::numeric_limits<double>::infinity());
}

TEST_P(D2co, RegistersEveryStartOnItsOwn) {
  Random random = test_random();
  PartScene scene("bearing_block", 2, random, *backend);
  const std::vector<EdgeModel> models{part_model("hex_nut"), scene.model};
  ObjectPose behind{1, inverse(scene.views[0].camera_from_world) *
                           Se3{Eigen::Quaterniond::Identity(), {0, 0, -3}}};
  const std::vector<ObjectPose> all{
      {0, scene.start.world_from_object}, {1, scene.start.world_from_object}, behind};
  const std::vector<PoseEstimate> found = solve({models, scene.views, *backend}, all);
  ASSERT_EQ(found.size(), 3u);
  const PoseEstimate alone = solve(scene);
  EXPECT_LT(distance_between_m(found[1].world_from_object, alone.world_from_object), 1e-9);
  EXPECT_EQ(found[1].points, alone.points);
  EXPECT_GT(distance_between_m(found[0].world_from_object, alone.world_from_object), 1e-4);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].object, all[i].object);
  EXPECT_TRUE(solve({models, scene.views, *backend}, {}).empty());
}

TEST_P(D2co, RefusesPosesThatAreNone) {
  Random random = test_random();
  PartScene scene("l_bracket", 1, random, *backend);
  const ObjectPose start = scene.start;
  scene.start.world_from_object.rotation.coeffs().setConstant(
      std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(solve(scene), LogicError);
  scene.start = start;
  scene.start.world_from_object.translation_m.z() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(solve(scene), LogicError);
  scene.start = start;
  scene.start.object = 1;
  EXPECT_THROW(solve(scene), LogicError);
  scene.start = start;
  scene.views[0].camera_from_world.translation_m.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solve(scene), LogicError);
}

TEST_P(D2co, RefusesOptionsOutOfRange) {
  Random random = test_random();
  const PartScene scene("l_bracket", 1, random, *backend);
  D2coOptions none;
  none.rounds.clear();
  EXPECT_THROW(solve(scene, none), InputError);
  for (const float scale : {0.0f, -1.0f, 1001.0f, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_THROW(solve(scene, one_round(LOSS_HUBER, scale, 10)), InputError) << scale;
  for (const int iterations : {0, -3, 1001})
    EXPECT_THROW(solve(scene, one_round(LOSS_HUBER, 4, iterations)), InputError) << iterations;
  EXPECT_THROW(solve(scene, one_round(2, 4, 10)), InputError) << "a loss that is none";
  D2coOptions options = one_round(LOSS_HUBER, 4, 10);
  options.rounds[0].max_points = -1;
  EXPECT_THROW(solve(scene, options), InputError);
  for (const double step : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    options = one_round(LOSS_HUBER, 4, 10);
    options.min_step_m = step;
    EXPECT_THROW(solve(scene, options), InputError) << step;
    options = one_round(LOSS_HUBER, 4, 10);
    options.min_step_rad = step;
    EXPECT_THROW(solve(scene, options), InputError) << step;
  }
}

TEST_P(D2co, WantsAView) {
  Random random = test_random();
  PartScene scene("l_bracket", 1, random, *backend);
  scene.views.clear();
  EXPECT_THROW(solve(scene), LogicError);
}

TEST(D2coSolver, IsKnownByName) {
  for (const Solver solver : {Solver::Batched, Solver::Ceres})
    EXPECT_EQ(solver_from_name(to_string(solver)), solver);
  EXPECT_THROW(solver_from_name("gauss"), InputError);
}

}  // namespace
}  // namespace edgescout
