#include "host/io/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "tests/io/expect_input_error.h"
#include "tests/io/sample_meshes.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

double volume(const Mesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six += mesh.vertices_m[a].dot(mesh.vertices_m[b].cross(mesh.vertices_m[c]));
  return six / 6;
}

// Every triangle with vertices of its own, as STL stores them.
Triangles unshared(const Triangles& mesh) {
  Triangles soup;
  for (const auto& triangle : mesh.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int v : triangle) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(MakeMesh, WeldsAndCompletesABox) {
  const Triangles soup = unshared(box(0.03, 0.04, 0.12));
  const Mesh mesh = make_mesh("box", soup.vertices, soup.triangles);
  EXPECT_EQ(mesh.name, "box");
  EXPECT_EQ(mesh.vertices_m.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(mesh.diameter_m, 0.13, 1e-15);
  EXPECT_EQ(mesh.box_min_m, Vector3d(0, 0, 0));
  EXPECT_EQ(mesh.box_max_m, Vector3d(0.03, 0.04, 0.12));
  EXPECT_NEAR(volume(mesh), 0.03 * 0.04 * 0.12, 1e-15);
  ASSERT_EQ(mesh.face_normals.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    const Vector3d from_centre =
        mesh.vertices_m[mesh.triangles[i][0]] - Vector3d(0.015, 0.02, 0.06);
    EXPECT_NEAR(mesh.face_normals[i].norm(), 1, 1e-12);
    EXPECT_NEAR(mesh.face_normals[i].cwiseAbs().maxCoeff(), 1, 1e-12);
    EXPECT_GT(mesh.face_normals[i].dot(from_centre), 0);
  }
}

TEST(MakeMesh, IsIdempotent) {
  const Triangles soup = unshared(box(1, 2, 3));
  const Mesh once = make_mesh("x", soup.vertices, soup.triangles);
  const Mesh twice = make_mesh("x", once.vertices_m, once.triangles);
  EXPECT_EQ(once.vertices_m, twice.vertices_m);
  EXPECT_EQ(once.triangles, twice.triangles);
}

// A roof on a square of 1 x 1; without a ridge it is a pyramid. The diameter is near sqrt(2).
Mesh roof(double ridge) {
  const std::vector<Vector3d> x{{0, 0, 0}, {1, 0, 0},       {1, 1, 0},
                                {0, 1, 0}, {0.5, 0.5, 0.5}, {0.5 + ridge, 0.5, 0.5}};
  return make_mesh(
      "roof", x,
      {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 5}, {2, 3, 4}, {2, 4, 5}, {3, 0, 4}});
}

TEST(MakeMesh, WeldsWithinAHundredThousandthOfTheDiameterOnly) {
  EXPECT_EQ(roof(1.4e-5).vertices_m.size(), 5u);
  EXPECT_EQ(roof(1.4e-5).triangles.size(), 6u) << "the needles are gone";
  EXPECT_EQ(roof(2.2e-5).vertices_m.size(), 6u);
  EXPECT_EQ(roof(2.2e-5).triangles.size(), 8u);
}

TEST(MakeMesh, JoinsBordersWithinThreeThousandthsOfTheDiameterOnly) {
  const auto vertices_of = [](double gap) {
    // Two triangles that share the side (1, 0, 0)-(0, 1, 0) but for the gap.
    const std::vector<Vector3d> x{{0, 0, 0},   {1, 0, 0}, {0, 1, 0},
                                  {1, 0, gap}, {1, 1, 0}, {0, 1, gap}};
    return make_mesh("gap", x, {{0, 1, 2}, {3, 4, 5}}).vertices_m.size();
  };
  EXPECT_EQ(vertices_of(1e-5), 4u);
  EXPECT_EQ(vertices_of(3e-3), 4u);
  EXPECT_EQ(vertices_of(5e-3), 6u);
}

TEST(MakeMesh, JoinsNoVerticesOfAClosedSurface) {
  EXPECT_EQ(roof(1e-3).vertices_m.size(), 6u) << "a ridge is no gap";
}

TEST(MakeMesh, WeldsARandomSoupAsBruteForceDoes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-1, 1);
  std::uniform_int_distribution<int> pick(0, 59);
  std::vector<Vector3d> sites, x;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < 60; ++i) sites.push_back({at(random), at(random), at(random)});
  for (int i = 0; i < 400; ++i) {
    const int first = static_cast<int>(x.size());
    for (int k = 0; k < 3; ++k)
      x.push_back(sites[pick(random)] + 1e-7 * Vector3d(at(random), at(random), at(random)));
    triangles.push_back({first, first + 1, first + 2});
  }
  const Mesh mesh = make_mesh("soup", x, triangles);
  EXPECT_EQ(mesh.vertices_m.size(), sites.size());
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((mesh.vertices_m[i] - mesh.vertices_m[j]).norm(), 1e-5 * mesh.diameter_m);
}

TEST(MakeMesh, DropsDegenerateAndDuplicateTrianglesAndStrayVertices) {
  Triangles b = box(1, 1, 1);
  b.vertices.push_back({100, 100, 100});  // used by no triangle
  b.vertices.push_back({0.5, 1e-9, 0});   // on the side 0-1
  b.triangles.push_back({0, 1, 9});       // no height
  b.triangles.push_back({3, 3, 4});       // two corners in one
  b.triangles.push_back({2, 1, 0});       // again, from another corner
  b.triangles.push_back({1, 2, 0});       // again, turned over
  const Mesh mesh = make_mesh("box", b.vertices, b.triangles);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.vertices_m.size(), 8u);
  EXPECT_NEAR(mesh.diameter_m, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
}

TEST(MakeMesh, RejectsWhatIsNoSurface) {
  const std::vector<Vector3d> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  expect_input_error([&] { make_mesh("m", x, {}); }, {"m: triangles", "none"});
  expect_input_error([&] { make_mesh("m", {}, {}); }, {"m: triangles", "none"});
  expect_input_error([&] { make_mesh("m", x, {{0, 1, 2}}); }, {"m: triangles", "without area"});
  expect_input_error(
      [&] {
        make_mesh("m", {x[1], x[1], x[1]}, {{0, 1, 2}});
      },
      {"m: triangles", "without area"});
  expect_input_error(
      [&] {
        make_mesh("m", {x[0], {1, 1e-5, 0}, x[2]}, {{0, 1, 2}});
      },
      {"m: triangles", "slivers"});
}

TEST(MakeMesh, RejectsVerticesThatAreNotFiniteAndIndicesOutOfRange) {
  const Triangles b = box(1, 1, 1);
  for (double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<Vector3d> x = b.vertices;
    x[5].y() = bad;
    expect_input_error([&] { make_mesh("m", x, b.triangles); }, {"m: vertex 5", "not finite"});
  }
  expect_input_error(
      [] {
        make_mesh("m", {}, {{0, 1, 2}});
      },
      {"m: vertices", "none", "at least 3"});
  expect_input_error(
      [&] {
        make_mesh("m", b.vertices, {{0, 1, 8}});
      },
      {"m: triangle 0", "vertex index 8", "0 to 7"});
  expect_input_error(
      [&] {
        make_mesh("m", b.vertices, {{0, 1, 2}, {0, -1, 2}});
      },
      {"m: triangle 1", "vertex index -1"});
}

TEST(MakeMesh, RejectsCoordinatesThatWouldOverflow) {
  Triangles b = box(1, 1, 1);
  b.vertices[2].x() = 1e308;
  expect_input_error([&] { make_mesh("m", b.vertices, b.triangles); }, {"m: vertex 2", "1e9 m"});
  const Triangles largest = box(1e9, 1e9, 1e9);
  EXPECT_EQ(make_mesh("m", largest.vertices, largest.triangles).vertices_m.size(), 8u);
}

TEST(LengthUnit, KnowsFourWords) {
  EXPECT_DOUBLE_EQ(metres_per(length_unit("mm")), 0.001);
  EXPECT_DOUBLE_EQ(metres_per(length_unit("cm")), 0.01);
  EXPECT_DOUBLE_EQ(metres_per(length_unit("m")), 1);
  EXPECT_DOUBLE_EQ(metres_per(length_unit("in")), 0.0254);
  for (const char* word : {"", "MM", "km", "mm "})
    expect_input_error([&] { length_unit(word); }, {"unit", "mm, cm, m or in"});
}

}  // namespace
}  // namespace edgescout::test
