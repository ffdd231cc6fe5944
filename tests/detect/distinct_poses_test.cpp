#include "host/detect/distinct_poses.h"

#include <gtest/gtest.h>

#include <numbers>

#include "host/render/parts.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"
#include "tests/detect/corner_distance.h"

namespace edgescout::test {
namespace {

TEST(SuppressDuplicates, KnowsAPoseUnderEverySymmetry) {
  const Object nut = make_part("hex_nut");
  ASSERT_GT(nut.symmetries.discrete.size(), 5u);
  Random random = test_random();
  const Se3 pose = any_pose(random);
  std::vector<Se3> poses;
  for (const Se3& symmetry : nut.symmetries.discrete)
    poses.push_back(randomly_moved(pose * symmetry, 0.0005, 0.01, random));
  EXPECT_EQ(suppress_duplicates(poses, nut.mesh, nut.symmetries, 0.003, 100),
            std::vector<std::size_t>{0});
  EXPECT_GT(suppress_duplicates(poses, nut.mesh, Symmetries{}, 0.003, 100).size(), 5u);
}

TEST(SuppressDuplicates, KeepsTheOrderAndAtMostTheNumberAskedFor) {
  const Object bracket = make_part("l_bracket");
  Random random = test_random();
  const Se3 a = any_pose(random), b = randomly_moved(a, 0.02, 0, random),
            c = randomly_moved(a, 0, 1.0, random);
  const std::vector<Se3> poses{
      b, randomly_moved(b, 0.0005, 0, random), a, randomly_moved(a, 0.0005, 0, random), c, b};
  EXPECT_EQ(suppress_duplicates(poses, bracket.mesh, bracket.symmetries, 0.002, 100),
            (std::vector<std::size_t>{0, 2, 4}));
  EXPECT_EQ(suppress_duplicates(poses, bracket.mesh, bracket.symmetries, 0.002, 2),
            (std::vector<std::size_t>{0, 2}));
  EXPECT_TRUE(suppress_duplicates({}, bracket.mesh, bracket.symmetries, 0.002, 2).empty());
}

TEST(BestDistinct, PrefersTheLowerKeyOfTwoDuplicates) {
  const Object bracket = make_part("l_bracket");
  Random random = test_random();
  const Se3 a = any_pose(random), b = randomly_moved(a, 0.02, 0, random);
  const std::vector<Se3> poses{randomly_moved(b, 0.0005, 0, random), a, b,
                               randomly_moved(a, 0.0005, 0, random)};
  const std::vector<double> keys{3, 2, 1, 2};
  const auto best = [&](std::size_t most) {
    return best_distinct(poses, keys, bracket.mesh, bracket.symmetries, 0.002, most);
  };
  EXPECT_EQ(best(100), (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(best(1), std::vector<std::size_t>{2});
  EXPECT_THROW(
      best_distinct(poses, std::vector<double>{1, 2}, bracket.mesh, bracket.symmetries, 0.002, 2),
      LogicError);
}

// Every dropped pose lies within the radius of an earlier kept one; no two kept ones do.
void expect_distinct(const Object& object, const std::vector<Se3>& poses, double radius_m) {
  const std::vector<std::size_t> kept =
      suppress_duplicates(poses, object.mesh, object.symmetries, radius_m, poses.size());
  EXPECT_GT(kept.size(), 3u);
  EXPECT_LT(kept.size(), poses.size() - 10);
  std::size_t next = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    double nearest = 1e9;
    for (std::size_t k = 0; k < next; ++k)
      nearest = std::min(nearest, brute_distance(poses[i], poses[kept[k]], object));
    const bool is_kept = next < kept.size() && kept[next] == i;
    EXPECT_EQ(is_kept, nearest >= radius_m) << i;
    next += is_kept;
  }
}

TEST(SuppressDuplicates, AgreesWithTheDistance) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "u_channel", "hex_nut"}) {
    SCOPED_TRACE(part);
    const Se3 origin = any_pose(random);
    std::vector<Se3> poses;
    for (int i = 0; i < 150; ++i)
      poses.push_back(
          randomly_moved(origin, random.uniform(0, 0.02), random.uniform(0, 0.6), random));
    expect_distinct(make_part(part), poses, 0.015);
  }
}

// A symmetry that moves the centre of the box: two poses can be equal with centres far apart.
TEST(SuppressDuplicates, AgreesWithTheDistanceWhereASymmetryMovesTheCentre) {
  Random random = test_random();
  Object object = make_part("l_bracket");
  const Eigen::Vector3d axis_m(0.05, 0.02, 0);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
  object.symmetries.discrete = {Se3{}, Se3{turn, axis_m - turn * axis_m}};
  const Se3 origin = any_pose(random);
  std::vector<Se3> poses;
  for (int i = 0; i < 150; ++i)
    poses.push_back(randomly_moved(origin * object.symmetries.discrete[std::size_t(i % 2)],
                                   random.uniform(0, 0.02), random.uniform(0, 0.6), random));
  expect_distinct(object, poses, 0.015);
}

// Before a camera, at distances that differ by a fifth.
std::vector<Se3> poses_in_view(int count, double place_m, double angle_rad, Random& random) {
  const Se3 origin{random.rotation(), {0.02, -0.03, 0.5}};
  std::vector<Se3> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back(
        randomly_moved(origin, random.uniform(0, place_m), random.uniform(0, angle_rad), random));
    poses.back().translation_m *= random.uniform(0.9, 1.1);
  }
  return poses;
}

double center_distance_m(const Se3& camera_from_object, const Mesh& mesh) {
  return (camera_from_object * Eigen::Vector3d(0.5 * (mesh.box_min_m + mesh.box_max_m))).norm();
}

// The largest distance of a corner of one pose from that of the other at the best symmetry, both
// scaled to a distance of 1 m.
double brute_distance_in_view(const Se3& a, const Se3& b, const Object& object) {
  const Mesh& mesh = object.mesh;
  double best = 1e9;
  for (const Se3& symmetry : object.symmetries.discrete) {
    const Se3 turned = a * symmetry;
    double worst = 0;
    for (double x : {mesh.box_min_m.x(), mesh.box_max_m.x()})
      for (double y : {mesh.box_min_m.y(), mesh.box_max_m.y()})
        for (double z : {mesh.box_min_m.z(), mesh.box_max_m.z()}) {
          const Eigen::Vector3d corner_m(x, y, z);
          worst = std::max(worst, (turned * corner_m / center_distance_m(turned, mesh) -
                                   b * corner_m / center_distance_m(b, mesh))
                                      .norm());
        }
    best = std::min(best, worst);
  }
  return best;
}

// More poses than are compared with the kept ones at once.
TEST(BestDistinctInView, AgreesWithTheDistanceInView) {
  Random random = test_random();
  ThreadPool threads(2);
  constexpr double fraction = 0.2;
  for (const char* part : {"l_bracket", "u_channel", "hex_nut"}) {
    SCOPED_TRACE(part);
    const Object object = make_part(part);
    // Places over several cells of the size of the radius.
    const std::vector<Se3> poses = poses_in_view(600, 2.5 * object.mesh.diameter_m, 0.8, random);
    std::vector<double> keys;
    for (std::size_t i = 0; i < poses.size(); ++i) keys.push_back(double(i));
    const std::vector<std::size_t> kept = best_distinct_in_view(
        poses, keys, object.mesh, object.symmetries, {fraction, poses.size()}, threads);
    EXPECT_GT(kept.size(), 20u);
    EXPECT_LT(kept.size(), poses.size() - 20);
    std::size_t next = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double radius =
          fraction * object.mesh.diameter_m / center_distance_m(poses[i], object.mesh);
      double nearest = 1e9;
      for (std::size_t k = 0; k < next; ++k)
        nearest = std::min(nearest, brute_distance_in_view(poses[i], poses[kept[k]], object));
      const bool is_kept = next < kept.size() && kept[next] == i;
      EXPECT_EQ(is_kept, nearest > radius) << i;
      next += is_kept;
    }
  }
}

// A step of a tenth in distance is a twentieth of the diameter in the image.
TEST(BestDistinctInView, TakesDistancesForSizes) {
  const Object bracket = make_part("l_bracket");
  ThreadPool threads(1);
  Se3 near{test_random().rotation(), {0.01, 0.02, 0.5}}, far = near, twice = near;
  far.translation_m *= 1.1, twice.translation_m *= 2;
  const std::vector<Se3> poses{twice, far, near};
  const auto best = [&](const std::vector<double>& keys, std::size_t most) {
    return best_distinct_in_view(poses, keys, bracket.mesh, bracket.symmetries, {0.2, most},
                                 threads);
  };
  EXPECT_EQ(best({0, 1, 2}, 9), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(best({0, 2, 1}, 9), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(best({2, 1, 0}, 1), std::vector<std::size_t>{2});
  EXPECT_THROW(best({1, 2}, 9), LogicError);
  EXPECT_TRUE(
      best_distinct_in_view({}, {}, bracket.mesh, bracket.symmetries, {0.2, 9}, threads).empty());
}

}  // namespace
}  // namespace edgescout::test
