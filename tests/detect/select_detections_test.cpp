#include "host/detect/select_detections.h"

#include <gtest/gtest.h>

#include "tests/active/rendered_scene.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

// A part that one camera sees and four others, which look past it, do not: they say nothing about
// it.
TEST(Settle, ViewsThatLookElsewhereTakeNothingFromAPose) {
  const RenderedScene scene({"l_bracket"}, 1, 1);
  const auto backend = make_cpu_backend(2);
  std::vector<RegisterView> views{scene.view(0, *backend)};
  const ObjectPose truth{0, scene.scene.placed[0].world_from_object};
  const DetectOptions options;
  const auto decided = [&] {
    const std::vector<Refined> refined =
        refine_poses(scene.models, {&truth, 1}, views, *backend, options.refine);
    return select_detections(scene.models, {&truth, 1}, refined, views, *backend, options);
  };
  const std::vector<Detection> alone = decided();
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_GT(alone[0].probability, 0.5);
  for (const double turn_rad : {-1.0, -0.9, 0.9, 1.0}) {
    views.push_back(views[0]);
    views.back().camera_from_world =
        Se3{so3_exp({0, turn_rad, 0}), {0, 0, 0}} * views[0].camera_from_world;
  }
  const std::vector<Detection> among_others = decided();
  ASSERT_EQ(among_others.size(), 1u);
  EXPECT_NEAR(among_others[0].probability, alone[0].probability, 0.02);
}

// Of two poses that would stand in one another, seen by two views that make both certain, one is
// there. From one view it cannot be told how far away they are, and both stay.
TEST(Settle, OfPosesInsideEachOtherTheBetterStays) {
  const RenderedScene scene({"l_bracket"}, 1, 2);
  const auto backend = make_cpu_backend(2);
  std::vector<RegisterView> views{scene.view(0, *backend), scene.view(1, *backend)};
  const Se3 truth = scene.scene.placed[0].world_from_object;
  const std::vector<ObjectPose> poses{
      {0, {truth.rotation, truth.translation_m + Eigen::Vector3d(0.01, 0, 0)}}, {0, truth}};
  std::vector<Refined> refined(2);
  for (std::size_t i = 0; i < 2; ++i) {
    refined[i].registration.world_from_object = poses[i].world_from_object;
    refined[i].by_view = pose_features_by_view(scene.models, {&poses[1], 1}, views, *backend, {});
  }
  refined[0].by_view[0].psi *= 0.98;
  DetectOptions options;
  options.restart_rotation_rad = 0;
  options.edge_claims.max_claimed = 1;
  const auto decided = [&] {
    return select_detections(scene.models, poses, refined, views, *backend, options);
  };
  std::vector<Detection> detections = decided();
  ASSERT_EQ(detections.size(), 1u);
  EXPECT_GT(detections[0].probability, 0.9);
  EXPECT_LT(distance_between_m(detections[0].world_from_object, truth), 1e-9);
  options.penetration_m = 0.5;
  EXPECT_EQ(decided().size(), 2u) << "allowed to";
  options.penetration_m = DEFAULT_PENETRATION_M;
  views.pop_back();
  for (Refined& r : refined) r.by_view.pop_back();
  EXPECT_EQ(decided().size(), 2u) << "one view";
  options.penetration_m = -1;
  expect_input_error([&] { options.validate(); }, {"penetration"});
}

}  // namespace
}  // namespace edgescout::test
