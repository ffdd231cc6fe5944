// Registration and judgement of poses by measured depth.
#include <gtest/gtest.h>

#include "host/register/depth_cost.h"
#include "host/register/depth_evidence.h"
#include "host/register/depth_offset.h"
#include "host/register/depth_systems.h"
#include "host/register/move_onto_depth.h"
#include "host/register/pose_classifier.h"
#include "host/register/pose_features.h"
#include "host/register/schedules.h"
#include "host/register/se3_manifold.h"
#include "tests/register/depth_scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

DepthEvidence evidence_of(const DepthScene& scene, const ObjectPose& pose, Backend& backend) {
  const Scene on = scene.on(backend);
  return depth_evidence(on, {&pose, 1}, visible_in_views(on, {&pose, 1}))(0, 0);
}

TEST(Depth, TheTruthAgrees) {
  const auto backend = make_reference_backend();
  Random random = test_random();
  for (const char* part : {"l_bracket", "bearing_block", "stepped_shaft"}) {
    const DepthScene scene(part, random, *backend);
    const DepthEvidence found = evidence_of(scene, scene.moved_m(0), *backend);
    EXPECT_GT(found.agreeing, 40) << part;
    EXPECT_LE(found.contradicting + found.hidden, 0.03 * found.agreeing) << part;
    EXPECT_LT(std::abs(found.offset_m / found.agreeing), 2e-4) << part;
  }
}

TEST(Depth, APoseBeforeTheSurfaceIsContradictedOneBehindIsHidden) {
  const auto backend = make_reference_backend();
  Random random = test_random();
  const DepthScene scene("l_bracket", random, *backend);
  const DepthEvidence before = evidence_of(scene, scene.moved_m(-0.03), *backend),
                      behind = evidence_of(scene, scene.moved_m(0.03), *backend);
  EXPECT_GT(before.contradicting, 0.8 * (before.agreeing + before.contradicting));
  EXPECT_LT(before.hidden, 0.1 * before.contradicting);
  EXPECT_GT(behind.hidden, 4 * (behind.agreeing + behind.contradicting));
}

TEST(Depth, AContradictedPoseIsLessProbableAnAgreeingOneMore) {
  const auto backend = make_reference_backend();
  Random random = test_random();
  const DepthScene scene("l_bracket", random, *backend);
  PoseFeatures features = pooled_features(scene.on(*backend), std::array{scene.moved_m(0)})[0];
  features.shading.pixels = 1;  // there is an image
  PoseFeatures blind = features, contradicted = features;
  blind.depth = {};
  contradicted.depth = evidence_of(scene, scene.moved_m(-0.03), *backend);
  EXPECT_GT(PoseClassifier::log_odds(features), PoseClassifier::log_odds(blind) + 1);
  EXPECT_LT(PoseClassifier::log_odds(contradicted), PoseClassifier::log_odds(blind) - 3);
}

// A pose that biased depth has moved returns to its edges.
TEST(Depth, OffsetsShowABias) {
  const auto backend = make_cpu_backend(2);
  Random random = test_random();
  DepthScene scene("l_bracket", random, *backend);
  ObjectView& view = scene.views[0];
  const std::vector<EdgePoint> edges = ideal_edges(part_model("l_bracket", 2e-4), view.camera,
                                                   view.camera_from_world * scene.truth, *backend);
  view.edges = std::make_shared<const EdgeIndex>(edges, view.camera.width, view.camera.height);
  const DepthImage right = view.depth->image;
  for (const double bias_m : {0.0, 0.005, -0.005}) {
    DepthImage biased = right;
    for (float& z_m : biased.z_m)
      if (z_m > 0) z_m += float(bias_m);
    set_depth(view, biased, scene.noise, *backend);
    const ObjectPose pose = scene.moved_m(bias_m);
    const std::vector<DepthOffset> offsets =
        depth_offsets({&scene.model, 1}, view, *backend, {&pose, 1});
    ASSERT_EQ(offsets.size(), 1u);
    EXPECT_GT(offsets[0].sigma_m, 0);
    EXPECT_LT(offsets[0].sigma_m, 0.003);
    EXPECT_NEAR(offsets[0].offset_m, bias_m, 4 * offsets[0].sigma_m);
  }
}

// What was not measured never counts against a pose.
TEST(Depth, WithoutAnyValueAllResultsAreThoseWithoutDepth) {
  const auto backend = make_cpu_backend(2);
  Random random = test_random();
  DepthScene scene("bearing_block", random, *backend);
  DepthImage empty = scene.views[0].depth->image;
  std::ranges::fill(empty.z_m, DEPTH_MISSING);
  set_depth(scene.views[0], empty, scene.noise, *backend);
  const auto registered = [&] {
    std::vector<PoseEstimate> poses =
        register_poses(scene.on(*backend), {&scene.start, 1}, D2coOptions{});
    measure_features(scene.on(*backend), poses);
    return poses[0];
  };
  const PoseEstimate with = registered();
  scene.forget_depth();
  const PoseEstimate without = registered();
  EXPECT_EQ(with.world_from_object.translation_m, without.world_from_object.translation_m);
  EXPECT_EQ(with.world_from_object.rotation.coeffs(), without.world_from_object.rotation.coeffs());
  EXPECT_EQ(PoseClassifier::log_odds(with.features[0]),
            PoseClassifier::log_odds(without.features[0]));
}

// The sum over parts and seeds: single cases may be lucky.
TEST(Depth, TheErrorAlongTheAxisFallsToAThirdWithBothSolvers) {
  const auto backend = make_cpu_backend(2);
  Random random = test_random();
  double without_m = 0, batched_m = 0, ceres_m = 0, apart_m = 0;
  for (const char* part : {"l_bracket", "bearing_block", "u_channel", "hex_nut"}) {
    DepthScene scene(part, random, *backend);
    // Edges of a detector, half a pixel off.
    const ObjectPose start = scene.moved_m(0.006);
    D2coOptions options = schedules::fine();
    const auto found = [&] {
      return register_poses(scene.on(*backend), {&start, 1}, options)[0].world_from_object;
    };
    const Se3 batched = found();
    options.solver = Solver::Ceres;
    const Se3 ceres = found();
    options.solver = Solver::Batched;
    batched_m += scene.axis_error_m(batched);
    ceres_m += scene.axis_error_m(ceres);
    apart_m += (batched.translation_m - ceres.translation_m).norm();
    scene.forget_depth();
    without_m += scene.axis_error_m(found());
  }
  EXPECT_LT(batched_m, 0.34 * without_m);
  EXPECT_LT(ceres_m, 0.34 * without_m);
  EXPECT_LT(apart_m / 4, 1e-4);
}

TEST(Depth, TheCovarianceIncludesIt) {
  const auto backend = make_cpu_backend(2);
  Random random = test_random();
  DepthScene scene("l_bracket", random, *backend);
  const auto variance_along_axis = [&] {
    const PoseEstimate found =
        register_poses(scene.on(*backend), {&scene.start, 1}, schedules::fine())[0];
    const Eigen::Vector3d axis =
        scene.views[0].camera_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    return axis.dot(found.covariance.topLeftCorner<3, 3>() * axis);
  };
  const double with = variance_along_axis();
  scene.forget_depth();
  EXPECT_LT(with, 0.2 * variance_along_axis());
}

TEST(Depth, ASurfaceBeforeThePartHidesItsEdges) {
  const auto backend = make_reference_backend();
  Random random = test_random();
  DepthScene scene("l_bracket", random, *backend);
  const ObjectPose truth = scene.moved_m(0);
  const std::size_t all = visible_in_views(scene.on(*backend), {&truth, 1})(0, 0).points.size();
  DepthImage covered = scene.views[0].depth->image;
  for (int y = 0; y < covered.height; ++y)
    for (int x = 0; x < covered.width / 2; ++x)
      covered.z_m[std::size_t(y) * std::size_t(covered.width) + std::size_t(x)] = 0.2f;
  set_depth(scene.views[0], covered, scene.noise, *backend);
  const VisibleInView half = visible_in_views(scene.on(*backend), {&truth, 1})(0, 0);
  EXPECT_EQ(half.unoccluded, all);
  EXPECT_LT(half.points.size(), 0.8 * double(all));
  EXPECT_GT(half.points.size(), 0.2 * double(all));
  for (const ModelPoint& point : half.points) {
    const Eigen::Vector3d seen = scene.views[0].camera_from_world *
                                 (scene.truth * Eigen::Vector3d(point.x_m, point.y_m, point.z_m));
    EXPECT_GT(project(scene.views[0].camera, seen).x(), covered.width / 2 - 6);
  }
}

TEST(Depth, StartsOffTheSurfaceAreMovedOntoIt) {
  const auto backend = make_reference_backend();
  Random random = test_random();
  const DepthScene scene("bearing_block", random, *backend);
  for (const double off_m : {-0.08, 0.08}) {
    const ObjectPose moved = moved_onto_depth(scene.on(*backend), scene.moved_m(off_m));
    EXPECT_LT(scene.axis_error_m(moved.world_from_object), 0.02) << off_m;
  }
  const ObjectPose near = scene.moved_m(0.001);
  EXPECT_EQ(moved_onto_depth(scene.on(*backend), near).world_from_object.translation_m,
            near.world_from_object.translation_m);
}

// Two derivations of one residual: the kernel's sums and Ceres' cost.
TEST(Depth, CeresCostIsTheKernels) {
  const auto backend = make_reference_backend();
  Random random = test_random();
  const DepthScene scene("l_bracket", random, *backend);
  const ObjectView& view = scene.views[0];
  const DepthImage& depth = view.depth->image;
  const DepthView measured{depth.z_m, depth.width, depth.height, intrinsics_of(view.camera)};
  PoseDepthOptions options = pose_depth_options(scene.on(*backend), JUDGEMENT_BAND);
  options.loss_scale = 1e6f;  // weights of 1
  const Se3 pose = scene.moved_m(0.001).world_from_object;
  const PoseParameters parameters = to_parameters(pose);
  int compared = 0;
  for (const SurfacePoint& sample : scene.model.surface_points) {
    const PoseProblem problem{to_pose(view.camera_from_world * pose), 0, 1, 0};
    PoseDepth sum;
    pose_depth_reference({&measured, 1}, {&sample, 1}, {&problem, 1}, options, {&sum, 1});
    double residual = -1, jacobian[7];
    double const* at = parameters.data();
    double* out = jacobian;
    ASSERT_TRUE(DepthCost(measured, view.camera_from_world, sample, options)
                    .Evaluate(&at, &residual, &out));
    if (sum.hidden > 0) {
      EXPECT_EQ(residual, HIDDEN_RESIDUAL);
      continue;
    }
    EXPECT_NEAR(0.5 * residual * residual, sum.cost, 1e-3 * (1 + sum.cost));
    if (sum.agreeing + sum.contradicting < 1) continue;
    ++compared;
    Eigen::Matrix<double, 7, 6, Eigen::RowMajor> ambient_by_tangent;
    Se3Manifold().PlusJacobian(parameters.data(), ambient_by_tangent.data());
    const Eigen::Matrix<double, 1, 6> gradient =
        residual * Eigen::Map<Eigen::Matrix<double, 1, 7>>(jacobian) * ambient_by_tangent;
    WorldSystem expected = world_system(sum, view.camera_from_world);
    EXPECT_LT((gradient.transpose() - expected.gradient).norm(),
              2e-3 * (1 + expected.gradient.norm()));
  }
  EXPECT_GT(compared, 50);
}

}  // namespace
}  // namespace edgescout::test
