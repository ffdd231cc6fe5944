#include "host/active/extrinsics_check.h"

#include <gtest/gtest.h>

#include "host/register/occluders.h"
#include "tests/active/rendered_scene.h"
#include "tests/io/collected_log.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

// A camera pose turned about the scene's centre: the parts stay in the image, in other places.
Se3 wrong(const Se3& camera_from_world, double angle_rad) {
  return camera_from_world * Se3{so3_exp({0.6 * angle_rad, 0, 0.8 * angle_rad}), {0, 0, 0}};
}

struct Objects {
  RenderedScene scene;
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<ObjectPose> poses;
  explicit Objects(int views) : scene({"l_bracket", "bearing_block"}, 4, views) {
    for (const PlacedObject& part : scene.scene.placed)
      poses.push_back({part.object, part.world_from_object});
  }
  std::vector<ExtrinsicsCheck> check(const std::vector<ObjectView>& views) {
    std::vector<ExtrinsicsCheck> checks = extrinsics_check({scene.models, views, *backend}, poses);
    log_disagreements(checks);
    return checks;
  }
};

void print(const std::vector<ExtrinsicsCheck>& views) {
  for (const ExtrinsicsCheck& v : views)
    std::printf("%.2f px by %d objects, %d missing%s\n", v.residual_px, v.objects, v.missing,
                v.disagrees ? ", disagrees" : "");
}

TEST(ExtrinsicsCheck, LogsOneWarning) {
  const CollectedLog log;
  std::vector<ExtrinsicsCheck> before(2), now(3);
  now[1] = {7.5, 2, 0, true};
  log_disagreements(now, before);
  ASSERT_EQ(log.messages.size(), 1u);
  before[1] = now[1];
  log_disagreements(now, before);
  EXPECT_EQ(log.messages.size(), 1u) << "it was known";
  now[2] = {0, 0, 3, true};
  log_disagreements(now, before);
  ASSERT_EQ(log.messages.size(), 2u);
  EXPECT_NE(log.messages[1].second.find("image 3"), std::string::npos) << log.messages[1].second;
}

TEST(ExtrinsicsCheck, KeepsAFlagUntilTheImageIsCheckedAgain) {
  const std::vector<ExtrinsicsCheck> before{{0.4, 2, 0, false}, {7.5, 2, 0, true}, {0, 0, 3, true}};
  std::vector<ExtrinsicsCheck> now(4);
  keep_unrefuted_flags(before, now);
  EXPECT_FALSE(now[0].disagrees || now[3].disagrees);
  EXPECT_TRUE(now[1].disagrees && now[2].disagrees);
  EXPECT_EQ(now[1].residual_px, 7.5);
  EXPECT_EQ(now[2].missing, 3);
  now[1] = {0.5, 1, 0, false};
  keep_unrefuted_flags(before, now);
  EXPECT_FALSE(now[1].disagrees) << "another image shows what it shows, in the same place";
}

// A pose that only one image shows, by chance, may move freely and proves nothing about the others.
TEST(ExtrinsicsCheck, AnObjectOfOneImageIsNoReference) {
  Objects t(3);
  std::vector<ObjectView> views = t.scene.views(*t.backend);
  views[0].camera_from_world = wrong(views[0].camera_from_world, 0.06);
  t.poses.resize(1);
  EXPECT_TRUE(t.check(views)[0].disagrees);
  // The others see nothing of it.
  for (const std::size_t covered : {1u, 2u}) {
    auto wall = std::make_shared<Occluders>();
    wall->camera = views[covered].camera;
    wall->depth_m.assign(std::size_t(wall->camera.width) * std::size_t(wall->camera.height), 0.05f);
    views[covered].occluders = wall;
  }
  const ExtrinsicsCheck alone = t.check(views)[0];
  EXPECT_EQ(alone.objects, 0);
  EXPECT_FALSE(alone.disagrees);
}

TEST(ExtrinsicsCheck, RightPosesAgree) {
  Objects t(3);
  const CollectedLog log;
  const std::vector<ExtrinsicsCheck> checks = t.check(t.scene.views(*t.backend));
  print(checks);
  for (const ExtrinsicsCheck& v : checks) {
    EXPECT_GE(v.objects, 2);
    EXPECT_LT(v.residual_px, 1.5);
    EXPECT_FALSE(v.disagrees);
  }
  EXPECT_TRUE(log.messages.empty());
}

TEST(ExtrinsicsCheck, FlagsTheOneThatIsWrong) {
  Objects t(3);
  for (const std::size_t odd : {0u, 2u}) {
    std::vector<ObjectView> views = t.scene.views(*t.backend);
    views[odd].camera_from_world = wrong(views[odd].camera_from_world, 0.06);
    const CollectedLog log;
    const std::vector<ExtrinsicsCheck> checks = t.check(views);
    print(checks);
    for (std::size_t v = 0; v < 3; ++v) EXPECT_EQ(checks[v].disagrees, v == odd) << v;
    ASSERT_EQ(log.messages.size(), 1u);
    EXPECT_NE(log.messages[0].second.find("image " + std::to_string(odd + 1)), std::string::npos)
        << log.messages[0].second;
  }
}

// So wrong that no registration finds the parts from there, but for one by chance.
TEST(ExtrinsicsCheck, FlagsTheOneThatShowsNothingWhereItShould) {
  Objects t(3);
  int bare = 0;
  for (const double angle_rad : {0.3, 0.5})
    for (const std::size_t odd : {0u, 1u, 2u}) {
      std::vector<ObjectView> views = t.scene.views(*t.backend);
      views[odd].camera_from_world = wrong(views[odd].camera_from_world, angle_rad);
      const CollectedLog log;
      const std::vector<ExtrinsicsCheck> checks = t.check(views);
      print(checks);
      for (std::size_t v = 0; v < 3; ++v) EXPECT_EQ(checks[v].disagrees, v == odd) << v;
      ASSERT_EQ(log.messages.size(), 1u);
      const std::string& text = log.messages[0].second;
      EXPECT_NE(text.find("image " + std::to_string(odd + 1)), std::string::npos) << text;
      const bool none = checks[odd].objects == 0;
      EXPECT_EQ(text.find("none of") != std::string::npos, none) << text;
      EXPECT_EQ(checks[odd].missing >= 2, none);
      bare += none;
    }
  EXPECT_GE(bare, 3);
}

// A view that shows its objects less well than the others do is not wrong.
TEST(ExtrinsicsCheck, DoesNotFlagAViewThatShowsTraces) {
  Objects t(3);
  const std::vector<ObjectView> views = t.scene.views(*t.backend);
  int flagged = 0;
  ExtrinsicsCheckOptions options;
  for (options.min_probability = 0.5; options.min_probability < 1;
       options.min_probability += 0.05) {
    const auto missing = [&](double absent_probability) {
      options.absent_probability = absent_probability;
      int most = 0;
      for (const ExtrinsicsCheck& v :
           extrinsics_check({t.scene.models, views, *t.backend}, t.poses, options))
        most = std::max(most, v.missing);
      return most;
    };
    flagged += missing(options.min_probability) > 0;
    EXPECT_EQ(missing(0.03), 0) << options.min_probability;
  }
  EXPECT_GT(flagged, 0) << "the case never arose";
}

// Where everything is hidden, or outside the image, nothing is missing.
TEST(ExtrinsicsCheck, ExpectsOnlyObjectsThatTheViewCanShow) {
  Objects t(3);
  std::vector<ObjectView> views = t.scene.views(*t.backend);
  views[2].camera_from_world = wrong(views[2].camera_from_world, 0.35);
  auto wall = std::make_shared<Occluders>();
  wall->camera = views[2].camera;
  wall->depth_m.assign(std::size_t(wall->camera.width) * std::size_t(wall->camera.height), 0.05f);
  views[2].occluders = wall;
  EXPECT_EQ(t.check(views)[2].missing, 0);
  views[2].occluders = nullptr;
  views[2].camera_from_world = Se3{so3_exp({0, 1.5, 0}), {0, 0, 0}} * views[2].camera_from_world;
  EXPECT_EQ(t.check(views)[2].missing, 0);
}

TEST(ExtrinsicsCheck, FlagsTheLaterOfTwoViews) {
  Objects t(2);
  std::vector<ObjectView> views = t.scene.views(*t.backend);
  views[0].camera_from_world = wrong(views[0].camera_from_world, 0.08);
  const std::vector<ExtrinsicsCheck> checks = t.check(views);
  print(checks);
  EXPECT_FALSE(checks[0].disagrees);
  EXPECT_TRUE(checks[1].disagrees);
}

TEST(ExtrinsicsCheck, OneViewOrNoObjectCannotDisagree) {
  Objects t(2);
  std::vector<ObjectView> views = t.scene.views(*t.backend);
  views[1].camera_from_world = wrong(views[1].camera_from_world, 0.08);
  EXPECT_FALSE(t.check({views[1]})[0].disagrees);
  t.poses.clear();
  for (const ExtrinsicsCheck& v : t.check(views)) {
    EXPECT_FALSE(v.disagrees);
    EXPECT_EQ(v.objects, 0);
  }
  EXPECT_TRUE(t.check({}).empty());
}

}  // namespace
}  // namespace edgescout::test
