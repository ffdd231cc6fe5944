#include "host/render/parts.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "host/render/solid.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

constexpr double PI = std::numbers::pi;

class Parts : public testing::TestWithParam<std::string> {};

// Every directed edge once, and its opposite once: closed, and all triangles wound alike.
void expect_closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> count;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++count[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, times] : count) {
    ASSERT_EQ(times, 1) << mesh.name << " edge " << edge.first << "-" << edge.second;
    ASSERT_EQ(count.count({edge.second, edge.first}), 1u)
        << mesh.name << " edge " << edge.first << "-" << edge.second;
  }
}

double nearest_vertex_m(const Mesh& mesh, const Eigen::Vector3d& x) {
  double nearest = 1;
  for (const Eigen::Vector3d& v : mesh.vertices_m) nearest = std::min(nearest, (v - x).norm());
  return nearest;
}

TEST_P(Parts, AreClosedAndFaceOutwards) {
  const Object part = make_part(GetParam());
  expect_closed(part.mesh);
  EXPECT_GT(enclosed_volume_m3(part.mesh), 1e-7);
}

TEST_P(Parts, AreSmallAndCentred) {
  const Object part = make_part(GetParam());
  EXPECT_GT(part.mesh.diameter_m, 0.03);
  EXPECT_LT(part.mesh.diameter_m, 0.09);
  EXPECT_LT(part.mesh.triangles.size(), 1500u);
  EXPECT_LT((part.mesh.box_min_m + part.mesh.box_max_m).norm(), 1e-9);
}

// Holes are drawn as polygons; those of the shaft's 48 segments against 64 sampled turns miss by a
// chord's height at most.
TEST_P(Parts, AreMappedOntoThemselvesBySymmetries) {
  const Object part = make_part(GetParam());
  EXPECT_LT(angle_between_rad(part.symmetries.discrete.front(), Se3{}), 1e-12);
  const double tolerance_m = turning_axes(std::vector{part}).empty() ? 1e-9 : 0.020 * PI / 48;
  for (const Se3& symmetry : part.symmetries.discrete)
    for (const Eigen::Vector3d& v : part.mesh.vertices_m)
      ASSERT_LT(nearest_vertex_m(part.mesh, symmetry * v), tolerance_m);
}

// No turn about a main axis that maps the part onto itself is missing from its symmetries.
TEST_P(Parts, NameAllTheirSymmetries) {
  const Object part = make_part(GetParam());
  for (int axis = 0; axis < 3; ++axis)
    for (const int steps : {2, 3, 4, 6, 12}) {
      const Se3 turn{so3_exp(2 * PI / steps * Eigen::Vector3d::Unit(axis)), {0, 0, 0}};
      double worst = 0, nearest = PI;
      for (const Eigen::Vector3d& v : part.mesh.vertices_m)
        worst = std::max(worst, nearest_vertex_m(part.mesh, turn * v));
      for (const Se3& s : part.symmetries.discrete)
        nearest = std::min(nearest, angle_between_rad(turn, s));
      if (worst < 1e-9) {
        EXPECT_LT(nearest, 2 * PI / 64) << "axis " << axis << ", a turn by 1/" << steps;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Parts, testing::ValuesIn(part_names()),
                         [](const auto& part) { return part.param; });

TEST(Part, UnknownNameIsRefused) {
  try {
    make_part("teapot");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("teapot"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("hex_nut"), std::string::npos);
  }
}

TEST(Part, IdsAreUniqueAndStartAtOne) {
  int id = 1;
  for (const std::string& name : part_names()) EXPECT_EQ(make_part(name).id, id++) << name;
}

TEST(ForeignPart, IsClosedAndHasItsVolume) {
  const Mesh box = make_box({0.03, 0.02, 0.01});
  expect_closed(box);
  EXPECT_NEAR(enclosed_volume_m3(box), 6e-6, 1e-12);
  const double polygon = 48 * std::sin(2 * PI / 48) / 2;  // area of the 48-gon in the unit circle
  const Mesh bar = make_bar(0.01, 0.05);
  expect_closed(bar);
  EXPECT_NEAR(enclosed_volume_m3(bar), polygon * 1e-4 * 0.05, 1e-12);
  const Mesh ring = make_ring(0.02, 0.01, 0.005);
  expect_closed(ring);
  EXPECT_NEAR(enclosed_volume_m3(ring), polygon * 3e-4 * 0.005, 1e-12);
}

TEST(Extrude, RemovesWhatItsHolesTakeOut) {
  Extrusion e;
  e.outline_mm = {{0, 0}, {40, 0}, {40, 30}, {0, 30}};
  e.height_mm = 20;
  e.holes_mm = {{{5, 5}, {5, 9}, {9, 9}, {9, 5}}, {{30, 20}, {30, 25}, {35, 25}, {35, 20}}};
  e.cross_holes = {{0, 2, 20, 10, 4}};
  const Mesh mesh = extrude("block", e);
  expect_closed(mesh);
  const double round = 24 * std::sin(2 * PI / 24) / 2 * 16;  // 24 corners, radius 4
  EXPECT_NEAR(1e9 * enclosed_volume_m3(mesh), (1200 - 16 - 25) * 20 - round * 30, 1e-6);
}

TEST(Triangulate, CoversThePolygonOnce) {
  const Loop2d comb{{0, 0}, {7, 0}, {7, 5}, {6, 5}, {6, 1}, {5, 1},
                    {5, 5}, {4, 5}, {4, 1}, {1, 1}, {1, 5}, {0, 5}};
  const std::vector<Loop2d> holes{circle({0.5, 3}, 0.3, true, 12), circle({4.5, 3}, 0.3, true, 12),
                                  circle({6.5, 3}, 0.3, true, 12)};
  Loop2d points = comb;
  double expected = signed_area(comb);
  for (const Loop2d& hole : holes) {
    points.insert(points.end(), hole.begin(), hole.end());
    expected += signed_area(hole);
  }
  double area = 0;
  for (const auto& [a, b, c] : triangulate(comb, holes)) {
    const double part = signed_area({points[a], points[b], points[c]});
    EXPECT_GT(part, 0);
    area += part;
  }
  EXPECT_NEAR(area, expected, 1e-12);
}

TEST(Triangulate, RefusesWrongLoops) {
  const Loop2d square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  EXPECT_THROW(triangulate({{0, 0}, {0, 4}, {4, 4}, {4, 0}}, {}), LogicError);
  EXPECT_THROW(triangulate(square, {circle({2, 2}, 1, false)}), LogicError);
  EXPECT_THROW(triangulate(square, {circle({9, 2}, 1, true)}), LogicError);
}

}  // namespace
}  // namespace edgescout
