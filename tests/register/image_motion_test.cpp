// How the image of a point moves with its pose, against differences of its projection.
#include "host/register/image_motion.h"

#include <gtest/gtest.h>

#include "host/model/visible_edges.h"
#include "tests/register/linear_tensor.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

TEST(ImageMotion, IsTheDerivativeOfTheProjection) {
  Random random = test_random();
  const Intrinsics k{700, 650, 239.5f, 179.5f};
  for (int tries = 0; tries < 50; ++tries) {
    const Se3 pose{random.rotation(), {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.4}};
    const ModelPoint point = random_point(random, 0.05);
    const double nx = random.normal(), ny = random.normal();
    const auto place = [&](const Se3& at) {
      const Landing l = land(k, at, point);
      return nx * l.u + ny * l.v;
    };
    const Vector6d motion = image_motion(nx, ny, pose_point<double>(to_pose(pose), point), k);
    for (int i = 0; i < 6; ++i) {
      const Vector6d step = 1e-6 * Vector6d::Unit(i);
      const double slope = (place(retract(pose, step)) - place(retract(pose, -step))) / 2e-6;
      EXPECT_NEAR(motion[i], slope, 1e-5 * motion.norm());
    }
  }
}

}  // namespace
}  // namespace edgescout
