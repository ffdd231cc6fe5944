// Registration on given points: on those that register_poses draws it is register_poses.
#include "host/register/register_points.h"

#include <gtest/gtest.h>

#include "host/register/visible_in_views.h"
#include "kernels/error.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

TEST(RegisterSeen, OnDrawnPointsIsRegisterPoses) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const PartScene scene("bearing_block", 2, random, *backend);
  int asked = 0;
  const auto drawn = [&](std::span<const ObjectPose> poses) {
    ++asked;
    std::vector<std::vector<ModelPoint>> points;
    for (const VisibleInView& seen :
         visible_in_views({&scene.model, 1}, poses, scene.views, *backend))
      points.push_back(seen.points);
    return points;
  };
  const std::vector<ObjectPose> starts{scene.start, {0, scene.truth}};
  const std::vector<Registration> expected =
      register_poses({&scene.model, 1}, starts, scene.views, *backend);
  const std::vector<Registration> found = register_points(starts, scene.views, drawn, *backend);
  EXPECT_EQ(asked, int(D2coOptions{}.rounds.size()));
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found[i].world_from_object.translation_m,
              expected[i].world_from_object.translation_m);
    EXPECT_EQ(found[i].world_from_object.rotation.coeffs(),
              expected[i].world_from_object.rotation.coeffs());
    EXPECT_EQ(found[i].cost_px2, expected[i].cost_px2);
    EXPECT_EQ(found[i].points, expected[i].points);
  }
}

TEST(RegisterSeen, PosesWithoutPointsStay) {
  Random random = test_random();
  const auto backend = make_cpu_backend(1);
  const PartScene scene("l_bracket", 2, random, *backend);
  const auto none = [&](std::span<const ObjectPose> poses) {
    return std::vector<std::vector<ModelPoint>>(poses.size() * 2);
  };
  const Registration found = register_points({&scene.start, 1}, scene.views, none, *backend)[0];
  EXPECT_EQ(found.reason, Convergence::NoPoints);
  EXPECT_EQ(found.points, 0);
  EXPECT_EQ(found.world_from_object.translation_m, scene.start.world_from_object.translation_m);
}

TEST(RegisterSeen, RefusesAnotherNumberOfLists) {
  Random random = test_random();
  const auto backend = make_cpu_backend(1);
  const PartScene scene("l_bracket", 2, random, *backend);
  const auto one = [](std::span<const ObjectPose>) {
    return std::vector<std::vector<ModelPoint>>(1);
  };
  EXPECT_THROW(register_points({&scene.start, 1}, scene.views, one, *backend), LogicError);
}

}  // namespace
}  // namespace edgescout::test
