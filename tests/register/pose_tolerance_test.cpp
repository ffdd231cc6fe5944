#include "host/register/pose_tolerance.h"

#include <gtest/gtest.h>

#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

// The centre is the object's, wherever the origin lies: a turn about the centre does not move it.
TEST(PoseTolerance, ComparesCentresAndOrientationsOfOneObject) {
  Random random = test_random();
  const std::vector<EdgeModel> models{part_model("l_bracket"), part_model("bearing_block")};
  const auto backend = make_cpu_backend(1);
  const Scene scene{models, {}, *backend};
  const thresholds::PoseTolerance tolerance{0.1, 0.05};
  const double reach_m = 0.1 * models[0].mesh.diameter_m;
  const ObjectPose pose{0, {random.rotation(), {0.3, -0.2, 0.5}}};
  const auto moved = [&](double by_m, double by_rad) {
    const Eigen::Vector3d center = pose.world_from_object * models[0].center_m;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(by_rad, random.direction()));
    const Eigen::Quaterniond rotation = turn * pose.world_from_object.rotation;
    const Eigen::Vector3d to = center + by_m * random.direction();
    return ObjectPose{0, {rotation, to - rotation * models[0].center_m}};
  };
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(is_same_pose(pose, moved(0.99 * reach_m, 0.049), scene, tolerance));
    EXPECT_FALSE(is_same_pose(pose, moved(1.01 * reach_m, 0), scene, tolerance));
    EXPECT_FALSE(is_same_pose(pose, moved(0, 0.051), scene, tolerance));
  }
  EXPECT_FALSE(is_same_pose(pose, {1, pose.world_from_object}, scene, tolerance));
}

}  // namespace
}  // namespace edgescout::test
