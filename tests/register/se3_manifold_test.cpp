// The invariants Ceres demands of a manifold, by Ceres' own matchers, and that the tangent is the
// project's.
#include "host/register/se3_manifold.h"

#include <ceres/manifold_test_utils.h>
#include <gtest/gtest.h>

#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace ceres;  // the matchers' macro names them bare

Vector random_pose(Random& random) {
  const PoseParameters p = to_parameters(
      {random.rotation(), {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}});
  return Eigen::Map<const Vector>(p.data(), 7);
}

Vector random_step(Random& random, double angle_rad) {
  Vector step(6);
  step << random.direction() * random.uniform(), random.direction() * angle_rad;
  return step;
}

// The same pose written with the quaternion that is nearer to x: q and -q turn alike, and Plus can
// return only one of them.
Vector near(const Vector& x, Vector y) {
  if (x.tail(4).dot(y.tail(4)) < 0) y.tail(4) *= -1;
  return y;
}

TEST(Se3Manifold, KeepsTheInvariantsOfCeres) {
  const Se3Manifold manifold;
  Random random = test::test_random();
  constexpr double tolerance = 1e-9;
  for (int i = 0; i < 200; ++i) {
    const Vector x = random_pose(random), y = near(x, random_pose(random));
    const Vector delta = random_step(random, random.uniform(0, 3.1));
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, tolerance);
  }
}

TEST(Se3Manifold, KeepsThemForTinyAndForAlmostHalfTurns) {
  const Se3Manifold manifold;
  Random random = test::test_random();
  for (const double angle : {1e-12, 1e-9, 1e-7, 1e-5, 3.1415, 3.141592})
    for (int i = 0; i < 20; ++i) {
      const Vector x = random_pose(random), delta = random_step(random, angle);
      Vector y(7);
      ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), y.data()));
      EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-8);
    }
}

TEST(Se3Manifold, MovesAsTheProjectDoes) {
  const Se3Manifold manifold;
  Random random = test::test_random();
  for (int i = 0; i < 50; ++i) {
    const Vector x = random_pose(random), delta = random_step(random, random.uniform(0, 3));
    Vector moved(7);
    ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), moved.data()));
    const Se3 start = from_parameters(x.data()), end = from_parameters(moved.data());
    // Written out: the translation adds, the rotation acts on the left by the full angle.
    EXPECT_NEAR((end.translation_m - start.translation_m - delta.head<3>()).norm(), 0, 1e-12);
    const Eigen::Matrix3d expected =
        Eigen::AngleAxisd(delta.tail<3>().norm(), delta.tail<3>().normalized()).toRotationMatrix() *
        start.rotation.toRotationMatrix();
    EXPECT_NEAR((end.rotation.toRotationMatrix() - expected).norm(), 0, 1e-12);
  }
}

}  // namespace
}  // namespace edgescout
