#include "host/active/camera_geometry_check.h"

#include <gtest/gtest.h>

#include "host/active/views.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

constexpr DistanceRange SEARCHED{0.3, 0.5};

// Five cameras around the origin, 0.4 m away.
std::vector<PosedCamera> around_origin() {
  const Camera camera{640, 480, 600, 600, 319.5, 239.5, {}};
  std::vector<PosedCamera> cameras;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Quaterniond turn = so3_exp({0.6, 0, 0}) * so3_exp({0, 0, 1.2 * i});
    cameras.push_back({camera, {turn, {0, 0, 0.4}}});
  }
  return cameras;
}

template <typename Change>
std::vector<PosedCamera> changed(std::vector<PosedCamera> cameras, const Change& change) {
  for (PosedCamera& camera : cameras) camera.camera_from_world = change(camera.camera_from_world);
  return cameras;
}

Se3 with_lengths(const Se3& pose, double factor) {
  return {pose.rotation, factor * pose.translation_m};
}

void expect_cause(const std::vector<PosedCamera>& cameras, const std::string& cause) {
  const std::optional<CameraPoseProblem> problem = camera_pose_problem(cameras, SEARCHED);
  ASSERT_TRUE(problem.has_value());
  EXPECT_NE(problem->likely_cause.find(cause), std::string::npos)
      << problem->found << "; " << problem->likely_cause;
}

TEST(CameraPoseProblem, IsNoneOfCamerasAroundAScene) {
  EXPECT_FALSE(camera_pose_problem(around_origin(), SEARCHED).has_value());
  EXPECT_TRUE(cameras_alone(around_origin(), SEARCHED).empty());
  EXPECT_NO_THROW(check_camera_poses(around_origin(), SEARCHED, "scene"));
  const std::vector<PosedCamera> one(1, around_origin()[0]);
  EXPECT_FALSE(camera_pose_problem(one, SEARCHED).has_value());
  EXPECT_NO_THROW(check_camera_poses(one, SEARCHED, "scene"));
}

TEST(CameraPoseProblem, NamesLengthsInAnotherUnit) {
  expect_cause(changed(around_origin(), [](const Se3& p) { return with_lengths(p, 1000); }),
               "lengths in mm where m are expected");
  expect_cause(changed(around_origin(), [](const Se3& p) { return with_lengths(p, 1e-3); }),
               "lengths in m where mm are expected");
}

TEST(CameraPoseProblem, NamesInvertedPoses) {
  expect_cause(changed(around_origin(), [](const Se3& p) { return inverse(p); }), "inverted");
}

// A camera that is moved along a row of parts: only neighbours see a place in common.
TEST(CameraPoseProblem, IsNoneOfARowOfCameras) {
  std::vector<PosedCamera> row(6, around_origin()[0]);
  for (std::size_t i = 0; i < row.size(); ++i)
    row[i].camera_from_world = {Eigen::Quaterniond::Identity(), {0.6 * double(i), 0, 0}};
  EXPECT_FALSE(camera_pose_problem(row, SEARCHED).has_value());
}

TEST(CamerasAlone, AreThoseThatSeeNothingOfTheOthers) {
  std::vector<PosedCamera> cameras = around_origin();
  cameras[3].camera_from_world.translation_m.z() = -3;  // the others look towards it from far away
  EXPECT_EQ(cameras_alone(cameras, SEARCHED), std::vector<std::size_t>{3});
}

TEST(CheckCameraPoses, RefusesCamerasThatShareNothing) {
  const auto far = changed(around_origin(), [](const Se3& p) { return with_lengths(p, 1000); });
  expect_input_error([&] { check_camera_poses(far, SEARCHED, "scene 7"); },
                     {"scene 7", "camera poses", "nothing in common", "in mm"});
}

}  // namespace
}  // namespace edgescout::test
