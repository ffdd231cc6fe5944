#include "host/render/pile.h"

#include <gtest/gtest.h>

#include <array>

#include "host/render/parts.h"

namespace edgescout {
namespace {

double lowest_m(const Mesh& mesh, const Se3& pose) {
  double low = 1e9;
  for (const Eigen::Vector3d& v : mesh.vertices_m) low = std::min(low, (pose * v).z());
  return low;
}

// Distance along `direction` (unit) to every crossing of the closed mesh, in the mesh's frame.
std::vector<double> crossings_m(const Mesh& mesh, const Eigen::Vector3d& from,
                                const Eigen::Vector3d& direction) {
  std::vector<double> distances;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices_m[ia], e1 = mesh.vertices_m[ib] - a,
                          e2 = mesh.vertices_m[ic] - a;
    const Eigen::Vector3d p = direction.cross(e2), s = from - a, q = s.cross(e1);
    const double determinant = e1.dot(p);
    if (std::abs(determinant) < 1e-18) continue;
    const double u = s.dot(p) / determinant, v = direction.dot(q) / determinant,
                 t = e2.dot(q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0) distances.push_back(t);
  }
  return distances;
}

// How deep a point lies in a closed mesh: 0 outside.
double depth_inside_m(const Mesh& mesh, const Eigen::Vector3d& x) {
  double depth = 1e9;
  int inside = 0;
  // Askew, so that no ray runs along a face.
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(1, 0.01, 0.02), Eigen::Vector3d(-0.02, 1, 0.01),
        Eigen::Vector3d(0.01, 0.02, 1), Eigen::Vector3d(-1, 0.02, 0.01),
        Eigen::Vector3d(0.01, -1, 0.02), Eigen::Vector3d(0.02, 0.01, -1)}) {
    const std::vector<double> distances = crossings_m(mesh, x, d.normalized());
    inside += distances.size() % 2;
    for (const double distance : distances) depth = std::min(depth, distance);
  }
  return inside >= 4 ? depth : 0;
}

TEST(RandomRest, PutsABoxOnOneOfItsFaces) {
  const Mesh box = make_box({0.06, 0.03, 0.02});
  Random random(11);
  int seen[3] = {};
  for (int i = 0; i < 60; ++i) {
    const Eigen::Matrix3d rotation = random_rest(box, random).toRotationMatrix();
    int axis = 0;
    const double most = rotation.row(2).cwiseAbs().maxCoeff(&axis);
    EXPECT_GT(most, std::cos(0.002));
    ++seen[axis];
  }
  EXPECT_GT(seen[2], seen[0]) << "the broad face catches most";
}

TEST(RandomRest, LaysABarDownOrStandsItUp) {
  const Mesh bar = make_bar(0.01, 0.06);
  Random random(12);
  for (int i = 0; i < 30; ++i) {
    const double up = std::abs((random_rest(bar, random) * Eigen::Vector3d::UnitZ()).z());
    EXPECT_TRUE(up < 0.01 || up > 0.9999) << up;
  }
}

TEST(SurfaceCentre, OfAShiftedBoxIsItsMiddle) {
  Mesh box = make_box({0.06, 0.03, 0.02});
  for (Eigen::Vector3d& v : box.vertices_m) v += Eigen::Vector3d(1, 2, 3);
  EXPECT_LT((surface_centre(box) - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
}

TEST(PileTable, LaysPartsApartOnTheBareTable) {
  Random random(13);
  PileTable table(1.0, 0.001);
  std::vector<std::pair<Mesh, Se3>> placed;
  for (int i = 0; i < 12; ++i) {
    const Mesh mesh = make_part(part_names()[i % 6]).mesh;
    const Se3 pose = table.place(mesh, 0.15, true, random);
    EXPECT_NEAR(lowest_m(mesh, pose), 0, 1e-6);
    placed.emplace_back(mesh, pose);
  }
  // Nothing above or below anything: no vertex of one lies straight above the other's triangles.
  for (const auto& [a, a_pose] : placed)
    for (const auto& [b, b_pose] : placed) {
      if (&a == &b) continue;
      const Se3 b_from_a = inverse(b_pose) * a_pose;
      for (const Eigen::Vector3d& v : a.vertices_m)
        EXPECT_TRUE(
            crossings_m(b, b_from_a * v, inverse(b_pose).rotation * -Eigen::Vector3d::UnitZ())
                .empty());
    }
}

TEST(PileTable, PilesPartsWithoutRunningThemIntoEachOther) {
  constexpr double CELL_M = 0.001;
  Random random(14);
  PileTable table(0.6, CELL_M);
  std::vector<std::pair<Mesh, Se3>> placed;
  double highest = 0;
  for (int i = 0; i < 10; ++i) {
    const Mesh mesh = make_part(part_names()[i % 6]).mesh;
    placed.emplace_back(mesh, table.place(mesh, 0.04, false, random));
    EXPECT_GT(lowest_m(mesh, placed.back().second), -1e-6);
    highest = std::max(highest, lowest_m(mesh, placed.back().second));
  }
  EXPECT_GT(highest, 0.005) << "some lie on others";
  for (const auto& [a, a_pose] : placed)
    for (const auto& [b, b_pose] : placed) {
      if (&a == &b) continue;
      const Se3 b_from_a = inverse(b_pose) * a_pose;
      for (const Eigen::Vector3d& v : a.vertices_m)
        EXPECT_LT(depth_inside_m(b, b_from_a * v), 2 * CELL_M) << a.name << " in " << b.name;
    }
}

// On others, too, a part rests on something: a little lower and it would run into them.
TEST(PileTable, LetsPartsDownUntilTheyTouch) {
  Random random(15);
  PileTable table(0.6, 0.001);
  const Mesh block = make_box({0.2, 0.2, 0.03}), cube = make_box({0.02, 0.02, 0.02});
  const Se3 under = table.place(block, 0.0, false, random);
  const double top = 2 * under.translation_m.z();  // its origin is its middle
  const Se3 pose = table.place(cube, 0.01, false, random);
  EXPECT_NEAR(lowest_m(cube, pose), top, 1e-4);
}

}  // namespace
}  // namespace edgescout
