// The nearest viewpoint, compared with a search over all viewpoints and symmetries.
#include "host/model/viewpoint_index.h"

#include <gtest/gtest.h>

#include <numbers>

#include "host/model/viewpoints.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

const Eigen::Vector3d CENTER_M(0.01, -0.003, 0.02);

// A quarter turn about the axis through the centre along z, four times.
Symmetries four_turns() {
  Symmetries symmetries;
  for (int i = 1; i < 4; ++i) {
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(i * std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
    symmetries.discrete.push_back({turn, CENTER_M - turn * CENTER_M});
  }
  return symmetries;
}

double cosine_of(const Eigen::Vector3d& towards_camera, const Se3& camera_from_object) {
  return towards_camera.dot((inverse(camera_from_object).translation_m - CENTER_M).normalized());
}

TEST(ViewpointIndex, FindsTheNearestViewpoint) {
  Random random = test_random();
  const Symmetries symmetries = four_turns();
  const std::vector<Eigen::Vector3d> viewpoints = viewpoints_in({}, symmetries, 4);
  const ViewpointIndex index(viewpoints, CENTER_M, symmetries);
  for (int i = 0; i < 200; ++i) {
    const Se3 pose{random.rotation(), 0.5 * random.direction()};
    const ViewpointIndex::Nearest found = index.nearest(pose);
    double largest = -1;
    for (const Se3& symmetry : symmetries.discrete)
      for (const Eigen::Vector3d& viewpoint : viewpoints)
        largest = std::max(largest, cosine_of(viewpoint, pose * symmetry));
    const double cosine =
        cosine_of(viewpoints[found.viewpoint], pose * index.symmetry(found.symmetry));
    EXPECT_NEAR(cosine, largest, 1e-12);
    EXPECT_NEAR(found.cosine, largest, 1e-12);
    EXPECT_GT(cosine, std::cos(ICOSPHERE_GAP_RAD / 4));
  }
}

TEST(ViewpointIndex, FindsEachViewpointOfASet) {
  TemplateSet set;
  set.model.center_m = CENTER_M;
  for (const Eigen::Vector3d& direction : edgescout::icosphere(3))
    set.views.push_back({looking_from(direction), {}});
  const ViewpointIndex index(set);
  for (std::size_t v = 0; v < set.views.size(); ++v) {
    const Eigen::Quaterniond& rotation = set.views[v].camera_from_object;
    const Se3 pose{rotation, Eigen::Vector3d(0, 0, 0.4) - rotation * CENTER_M};
    EXPECT_EQ(index.nearest(pose).viewpoint, v);
    EXPECT_EQ(index.nearest(pose).symmetry, 0u);
  }
}

}  // namespace
}  // namespace edgescout::test
