// Registration on given points: on the points of register_poses it equals register_poses.
#include "host/register/d2co.h"

#include <gtest/gtest.h>

#include "host/register/visible_in_views.h"
#include "kernels/error.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

TEST(RegisterPoints, OnDrawnPointsIsRegisterPoses) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const PartScene scene("bearing_block", 2, random, *backend);
  int calls = 0;
  const auto drawn = [&](std::span<const ObjectPose> poses, const D2coRound& round) {
    ++calls;
    const Grid<VisibleInView> visible = visible_in_views(scene.on(*backend), poses);
    return VisiblePoints{
        points_of(visible, &VisibleInView::points, round.max_points, backend->threads()),
        {{}, {visible.rows(), visible.columns()}}};
  };
  const std::vector<ObjectPose> starts{scene.start, {0, scene.truth}};
  const std::vector<PoseEstimate> expected = register_poses(scene.on(*backend), starts);
  const std::vector<PoseEstimate> found = register_points(scene.on(*backend), starts, drawn);
  EXPECT_EQ(calls, int(D2coOptions{}.rounds.size()));
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

TEST(RegisterPoints, PosesWithoutPointsStay) {
  Random random = test_random();
  const auto backend = make_cpu_backend(1);
  const PartScene scene("l_bracket", 2, random, *backend);
  const auto none = [&](std::span<const ObjectPose> poses, const D2coRound&) {
    return VisiblePoints{{{}, {poses.size(), 2}}, {{}, {poses.size(), 2}}};
  };
  const PoseEstimate found = register_points(scene.on(*backend), {&scene.start, 1}, none)[0];
  EXPECT_EQ(found.convergence, Convergence::NoPoints);
  EXPECT_EQ(found.points, 0);
  EXPECT_EQ(found.world_from_object.translation_m, scene.start.world_from_object.translation_m);
}

TEST(RegisterPoints, RefusesAnotherNumberOfRanges) {
  Random random = test_random();
  const auto backend = make_cpu_backend(1);
  const PartScene scene("l_bracket", 2, random, *backend);
  const auto one = [](std::span<const ObjectPose>, const D2coRound&) {
    return VisiblePoints{{{}, {1, 1}}, {{}, {1, 2}}};
  };
  EXPECT_THROW(register_points(scene.on(*backend), {&scene.start, 1}, one), LogicError);
}

}  // namespace
}  // namespace edgescout::test
