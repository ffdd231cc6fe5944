#include "host/detect/distinct_poses.h"

#include <gtest/gtest.h>

#include "host/render/parts.h"
#include "tests/detect/corner_distance.h"

namespace edgescout::test {
namespace {

TEST(PoseDistance, IsTheLargestOverCornersAtTheBestSymmetry) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "hex_nut"}) {
    const Object object = make_part(part);
    for (int i = 0; i < 50; ++i) {
      const Se3 a = any_pose(random),
                b = i % 2 ? any_pose(random) : randomly_moved(a, 0.01, 0.5, random);
      EXPECT_NEAR(pose_distance_m(a, b, object.mesh, object.symmetries),
                  brute_distance(a, b, object), 1e-12);
    }
  }
}

TEST(KnownPoses, AreFoundNearModuloSymmetry) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "hex_nut"}) {
    const Object object = make_part(part);
    std::vector<Se3> known;
    for (int i = 0; i < 4; ++i) known.push_back(any_pose(random));
    const KnownPoses poses(known, object.mesh, object.symmetries);
    int near = 0;
    for (int i = 0; i < 400; ++i) {
      const Se3 turned =
          known[i % 4] * object.symmetries.discrete[i % object.symmetries.discrete.size()];
      const Se3 pose =
          randomly_moved(turned, random.uniform(0, 0.02), random.uniform(0, 0.6), random);
      double nearest = 1e9;
      for (const Se3& k : known) nearest = std::min(nearest, brute_distance(pose, k, object));
      EXPECT_EQ(poses.any_within(0.015, pose), nearest < 0.015) << part << " " << i;
      near += nearest < 0.015;
    }
    EXPECT_GT(near, 40);
    EXPECT_LT(near, 360);
    EXPECT_FALSE(
        KnownPoses(std::span<const Se3>{}, object.mesh, object.symmetries).any_within(1, known[0]));
  }
}

}  // namespace
}  // namespace edgescout::test
