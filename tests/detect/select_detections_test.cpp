#include "host/detect/select_detections.h"

#include <gtest/gtest.h>

#include "host/register/pose_classifier.h"
#include "tests/active/rendered_scene.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

// One camera sees a part; four others look past it and do not count.
TEST(SelectDetections, ViewsThatLookElsewhereDoNotCountAgainstAPose) {
  const RenderedScene scene({"l_bracket"}, 1, 1);
  const auto backend = make_cpu_backend(2);
  std::vector<ObjectView> views{scene.view(0, *backend)};
  const ObjectPose truth{0, scene.scene.placed[0].world_from_object};
  const DetectOptions options;
  const auto selected = [&] {
    const Scene seen{scene.models, views, *backend};
    return select_detections(seen, scene.sets, refine_poses(seen, {&truth, 1}, options.refine),
                             options);
  };
  const std::vector<Detection> alone = selected();
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_GT(alone[0].probability, 0.5);
  for (const double turn_rad : {-1.0, -0.9, 0.9, 1.0}) {
    views.push_back(views[0]);
    views.back().camera_from_world =
        Se3{so3_exp({0, turn_rad, 0}), {0, 0, 0}} * views[0].camera_from_world;
  }
  const std::vector<Detection> among_others = selected();
  ASSERT_EQ(among_others.size(), 1u);
  EXPECT_NEAR(among_others[0].probability, alone[0].probability, 0.02);
}

// A pose below the threshold competes: refined from turned starts it may pass.
TEST(SelectDetections, PosesBelowTheThresholdCompeteAndAreNotReported) {
  const RenderedScene scene({"l_bracket"}, 1, 1);
  const auto backend = make_cpu_backend(2);
  const std::vector<ObjectView> views{scene.view(0, *backend)};
  const Scene seen{scene.models, views, *backend};
  const ObjectPose truth{0, scene.scene.placed[0].world_from_object};
  DetectOptions options;
  const std::vector<PoseEstimate> refined = refine_poses(seen, {&truth, 1}, options.refine);
  const double probability = select_detections(seen, scene.sets, refined, options)[0].probability;
  ASSERT_GT(probability, 0.5);
  for (const double margin : {-0.01, 0.01}) {
    options.min_probability = probability + margin;
    SelectionTrace trace;
    const std::size_t reported = margin < 0 ? 1 : 0;
    EXPECT_EQ(select_detections(seen, scene.sets, refined, options, &trace).size(), reported);
    EXPECT_EQ(trace.selected.size(), reported);
    EXPECT_EQ(trace.less_probable.size(), 1 - reported);
    EXPECT_FALSE(trace.competing.empty());
  }
}

// Two views make two poses certain that reach into each other: one is kept. One view does not
// determine their distances, and both are kept.
TEST(SelectDetections, OfPosesInsideEachOtherTheBetterStays) {
  const RenderedScene scene({"l_bracket"}, 1, 2);
  const auto backend = make_cpu_backend(2);
  std::vector<ObjectView> views{scene.view(0, *backend), scene.view(1, *backend)};
  const Se3 truth = scene.scene.placed[0].world_from_object;
  const std::vector<ObjectPose> poses{
      {0, {truth.rotation, truth.translation_m + Eigen::Vector3d(0.01, 0, 0)}}, {0, truth}};
  std::vector<PoseEstimate> refined(2);
  for (std::size_t i = 0; i < 2; ++i) {
    refined[i].world_from_object = poses[i].world_from_object;
    const Grid<PoseFeatures> features =
        features_by_view({scene.models, views, *backend}, {&poses[1], 1});
    refined[i].features.assign(features.row(0).begin(), features.row(0).end());
  }
  refined[0].features[0].psi *= 0.98;
  for (PoseEstimate& r : refined) classify(r);
  DetectOptions options;
  options.restart_rotation_rad = 0;
  options.edge_claims.max_claimed = 1;
  const auto selected = [&] {
    return select_detections({scene.models, views, *backend}, scene.sets, refined, options);
  };
  std::vector<Detection> detections = selected();
  ASSERT_EQ(detections.size(), 1u);
  EXPECT_GT(detections[0].probability, 0.9);
  EXPECT_LT(distance_between_m(detections[0].world_from_object, truth), 1e-9);
  options.penetration_m = 0.5;
  EXPECT_EQ(selected().size(), 2u) << "they may reach so far";
  options.penetration_m = DEFAULT_PENETRATION_M;
  views.pop_back();
  for (PoseEstimate& r : refined) r.features.pop_back(), classify(r);
  EXPECT_EQ(selected().size(), 2u) << "one view";
  options.penetration_m = -1;
  expect_input_error([&] { options.validate(); }, {"penetration"});
}

}  // namespace
}  // namespace edgescout::test
