#include "host/detect/settle.h"

#include <gtest/gtest.h>

#include "tests/active/rendered_scene.h"

namespace edgescout::test {
namespace {

// A part that one camera sees and four others, which look past it, do not: they say nothing about it.
TEST(Settle, ViewsThatLookElsewhereTakeNothingFromAPose) {
  const RenderedScene scene({"l_bracket"}, 1, 1);
  const auto backend = make_cpu_backend(2);
  std::vector<RegisterView> views{scene.view(0, *backend)};
  const Hypothesis truth{0, scene.scene.placed[0].world_from_object};
  const DetectOptions options;
  const auto settled = [&] {
    const std::vector<Refined> refined =
        refine_poses(scene.models, {&truth, 1}, views, *backend, options.refine);
    return settle(scene.models, {&truth, 1}, refined, views, *backend, options);
  };
  const std::vector<Detection> alone = settled();
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_GT(alone[0].probability, 0.5);
  for (const double turn_rad : {-1.0, -0.9, 0.9, 1.0}) {
    views.push_back(views[0]);
    views.back().camera_from_world = Se3{so3_exp({0, turn_rad, 0}), {0, 0, 0}} * views[0].camera_from_world;
  }
  const std::vector<Detection> among_others = settled();
  ASSERT_EQ(among_others.size(), 1u);
  EXPECT_NEAR(among_others[0].probability, alone[0].probability, 0.02);
}

}  // namespace
}  // namespace edgescout::test
