#include "host/register/coarse_registration.h"

#include <gtest/gtest.h>

#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

// Levels without tensors: what is asked of them is only their reduction.
ObjectView view_with_levels(std::initializer_list<double> reductions) {
  ObjectView view;
  view.camera = scene_camera();
  for (const double reduction : reductions) view.reduced.push_back({{}, {}, {}, reduction});
  return view;
}

TEST(CoarseRegistration, ChoosesTheLevelThatMakesAnObject48Pixels) {
  const ObjectView view = view_with_levels({1, 2, 4, 8});
  EXPECT_EQ(level_for(10, view), 0u);
  EXPECT_EQ(level_for(48, view), 0u);
  EXPECT_EQ(level_for(67, view), 0u);  // the geometric mean of 48 and 96 is 67.9
  EXPECT_EQ(level_for(69, view), 1u);
  EXPECT_EQ(level_for(200, view), 2u);
  EXPECT_EQ(level_for(5000, view), 3u);
  EXPECT_EQ(level_for(200, view_with_levels({})), 0u);
}

// Poses at distances of all levels, in mixed order, of two objects of different sizes.
TEST(CoarseRegistration, RegistersEachStartOnItsLevelAndKeepsTheOrder) {
  const auto backend = make_cpu_backend(1);
  const std::vector<EdgeModel> models{part_model("l_bracket"), part_model("u_channel")};
  const std::vector<ObjectView> views{view_with_levels({1, 2, 4, 8})};
  const Scene scene{models, views, *backend};
  Random random = test_random();
  std::vector<ObjectPose> starts;
  for (int i = 0; i < 60; ++i)
    starts.push_back(
        {int(random.below(2)), {random.rotation(), {0, 0, 0.1 * std::exp(random.uniform(0, 3))}}});
  std::vector<int> calls(4);
  const std::vector<PoseEstimate> found = register_coarsely(
      scene, starts, [&](const Scene& on_level, std::span<const ObjectPose> poses) {
        std::vector<PoseEstimate> estimates;
        for (const ObjectPose& pose : poses) {
          const EdgeModel& model = models[std::size_t(pose.object)];
          static_cast<ObjectPose&>(estimates.emplace_back()) = pose;
          estimates.back().mean_px =
              double(level_of_pose(on_level.views[0], model, pose.world_from_object));
        }
        const auto level = std::size_t(estimates[0].mean_px);
        ++calls[level];
        for (const PoseEstimate& estimate : estimates) EXPECT_EQ(estimate.mean_px, double(level));
        return estimates;
      });
  EXPECT_EQ(calls, std::vector<int>(4, 1));
  ASSERT_EQ(found.size(), starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(found[i].object, starts[i].object);
    EXPECT_EQ(found[i].world_from_object.translation_m, starts[i].world_from_object.translation_m);
  }
}

}  // namespace
}  // namespace edgescout::test
