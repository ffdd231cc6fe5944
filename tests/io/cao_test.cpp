#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/io/mesh.h"
#include "host/io/raw_mesh.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

double area(const RawMesh& mesh) {
  double twice = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    twice +=
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  return twice / 2;
}

RawMesh read(const std::string& text) {
  const TemporaryFolder folder;
  return read_cao(folder.write("m.cao", text));
}

const std::string square = "V1\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(Cao, ReadsFacesFromPoints) {
  const RawMesh mesh = read(square + "0\n0\n1\n4 0 1 2 3\n0\n0\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(area(mesh), 1);
}

TEST(Cao, ReadsFacesFromSegmentsInAnyDirection) {
  const RawMesh mesh = read(square + "4\n1 0\n1 2\n3 2\n3 0\n1\n4 0 1 2 3\n0\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(area(mesh), 1);
  expect_input_error([] { read(square + "4\n0 1\n1 2\n2 3\n3 0\n1\n3 0 1 2\n0\n"); },
                     {"m.cao", "open"});
  expect_input_error([] { read(square + "4\n0 1\n1 2\n2 3\n3 0\n1\n4 0 2 1 3\n0\n"); },
                     {"m.cao", "gap"});
}

TEST(Cao, TurnsCylindersIntoSideWallsSeenFromOutside) {
  const RawMesh mesh = read("V1\n2\n1 2 3\n1 2 8\n0\n0\n0\n1\n0 1 2\n0\n");
  EXPECT_NEAR(area(mesh), 2 * std::numbers::pi * 2 * 5, 0.002 * area(mesh));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d x = mesh.vertices[a];
    EXPECT_NEAR(std::hypot(x.x() - 1, x.y() - 2), 2, 1e-12);
    const Vector3d normal = (mesh.vertices[b] - x).cross(mesh.vertices[c] - x);
    EXPECT_GT(normal.dot(Vector3d(x.x() - 1, x.y() - 2, 0)), 0);
  }
}

// A cylinder with a circle on either end, one of them against the axis: the rims weld, so the body
// is closed.
TEST(Cao, WeldsCirclesToTheRimsOfACylinder) {
  const std::string text =
      "V1\n6\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n1 0 1\n0 1 1\n0\n0\n0\n1\n0 1 0.5\n2\n0.5 0 3 2\n0.5 1 4 "
      "5\n";
  RawMesh raw = read(text);
  const Mesh mesh = make_mesh("tin", raw.vertices, raw.triangles);
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six += mesh.vertices_m[a].dot(mesh.vertices_m[b].cross(mesh.vertices_m[c]));
  EXPECT_NEAR(six / 6, std::numbers::pi * 0.25, 0.002);
  EXPECT_EQ(mesh.vertices_m.size(), 2u * 64 + 2);
  // Euler: a closed body without holes.
  EXPECT_EQ(2 * mesh.vertices_m.size(), mesh.triangles.size() + 4);
}

TEST(Cao, IgnoresCommentsSettingsAndLineEnds) {
  std::string text =
      "# model\nV1 # version\n\n4 # points\n0 0 0\n1 0 0 # b\n1 1 0\n0 1 0\n0\n0\n1\n"
      "4 0 1 2 3 name=front useLod=true minLineLengthThreshold=50 # face\n0\n0";
  EXPECT_EQ(read(text).triangles.size(), 2u);
  std::string windows;
  for (char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(windows).triangles.size(), 2u);
}

// ViSP takes nothing but a row's numbers from its line.
TEST(Cao, IgnoresWhatFollowsTheNumbersOfARow) {
  const std::string text =
      "V1 // format\n4 points\n0 0 0 // a\n1 0 0 b 7\n1 1 0\n0 1 0\n0 // no line\n0\n1 - a face\n"
      "4 0 1 2 3 name=\"the top\" useLod = true\n0 cylinders\n0\n";
  EXPECT_DOUBLE_EQ(area(read(text)), 1);
  // V2 has the place of each point in an image.
  EXPECT_DOUBLE_EQ(
      area(read("V2\n4\n0 0 0 5 6\n1 0 0 7 8\n1 1 0 9 9\n0 1 0 1 1\n0\n0\n1\n4 0 1 2 3\n")), 1);
}

TEST(Cao, PlacesWhatItIncludes) {
  const TemporaryFolder folder;
  folder.write("a.cao", square + "0\n0\n1\n4 0 1 2 3\n");
  const auto placed = [&](const std::string& how) {
    return read_cao(folder.write("m.cao", "V1\nload(\"a.cao\"" + how + ")\n0\n0\n0\n0\n"));
  };
  const RawMesh turned = placed(", t=[0; 0; 5], tu=[0; 0; 90deg]");
  ASSERT_EQ(turned.vertices.size(), 4u);
  EXPECT_LT((turned.vertices[1] - Vector3d(0, 1, 5)).norm(), 1e-12);
  EXPECT_LT((turned.vertices[2] - Vector3d(-1, 1, 5)).norm(), 1e-12);
  EXPECT_LT((placed(", tu=[0;0;1.5707963267948966rad]").vertices[1] - Vector3d(0, 1, 0)).norm(),
            1e-12);
  expect_input_error([&] { placed(", t=[1; 2]"); }, {"m.cao", "line 2", "three numbers"});
  expect_input_error([&] { placed(", scale=2"); }, {"m.cao", "line 2", "scale=2", "tu="});
  expect_input_error([&] { placed(", t=[1; x; 2]"); }, {"m.cao", "line 2", "x", "a number"});
}

TEST(Cao, HasAtMostTwoThousandRings) {
  std::string text = "V1\n2\n0 0 0\n0 0 1\n0\n0\n0\n1001\n";
  for (int i = 0; i < 1001; ++i) text += "0 1 2\n";
  expect_input_error([&] { read(text); }, {"m.cao", "2000"});
}

TEST(Cao, CylindersAndCirclesMayBeLeftOut) {
  EXPECT_EQ(read(square + "0\n0\n1\n4 0 1 2 3\n").triangles.size(), 2u);
  EXPECT_EQ(read(square + "0\n0\n1\n4 0 1 2 3\n0\n").triangles.size(), 2u);
}

TEST(Cao, IncludesOtherFilesFromItsOwnFolder) {
  const TemporaryFolder folder;
  folder.write("parts/a.cao", square + "0\n0\n1\n4 0 1 2 3\n");
  folder.write("parts/b.cao", "load(\"a.cao\")\n" + square + "0\n0\n1\n3 0 1 2\n");
  const auto whole = folder.write("whole.cao", "V1\nload(\"parts/b.cao\")\n0\n0\n0\n0\n0\n0\n");
  EXPECT_DOUBLE_EQ(area(read_cao(whole)), 1.5);
  const auto missing = folder.write("m.cao", "V1\nload(\"no.cao\")\n0\n0\n0\n0\n");
  expect_input_error([&] { read_cao(missing); }, {"no.cao", "No such file"});
  const auto endless = folder.write("c.cao", "V1\nload(\"c.cao\")\n0\n0\n0\n0\n");
  expect_input_error([&] { read_cao(endless); }, {"c.cao", "load"});
}

TEST(Cao, NamesTheLineOfWhatIsWrong) {
  expect_input_error([] { read("V3\n"); }, {"m.cao", "line 1", "V3", "V1"});
  expect_input_error([] { read("V1\n1\n0 x 0\n"); }, {"line 3", "x", "a number"});
  expect_input_error([] { read("V1\n-1\n"); }, {"line 2", "-1"});
  expect_input_error([] { read(square + "0\n0\n1\n4 0 1 2 4\n"); },
                     {"line 10", "point index below 4"});
  expect_input_error([] { read(square + "1\n0 7\n"); }, {"line 8", "point index below 4"});
  expect_input_error([] { read(square + "0\n0\n1\n4 0 1 2 3\n1\n0 1 -2\n"); },
                     {"line 12", "radius"});
  expect_input_error([] { read(square + "0\n0\n1\n4 0 1 2 3\n1\n1 1 2\n"); },
                     {"line 12", "no length"});
  expect_input_error([] { read(square + "0\n0\n0\n0\n1\n1 0 1 1\n"); },
                     {"line 12", "without a plane"});
  expect_input_error([] { read(square + "0\n0\n1\n4 0 1 2 3\n0\n0\n9\n"); },
                     {"9", "the end of the file"});
  expect_input_error([] { read(square + "0\n0\n2\n4 0 1 2 3\n"); }, {"truncated"});
}

TEST(Cao, NamesTheFileThatLoadsAnother) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.cao", "load(\"none.cao\")\nV1\n0\n0\n0\n0\n");
  expect_input_error([&] { load_mesh(file, LengthUnit::Metre); },
                     {"a.cao: load(\"none.cao\")", "No such file"});
}

TEST(Cao, LimitsCircles) {
  std::string circles = square + "0\n0\n0\n0\n2001\n";
  for (int i = 0; i < 2001; ++i) circles += "1 0 1 2\n";
  expect_input_error([&] { read(circles); },
                     {"line 2012", "at most 2000 ends of cylinders and circles"});
}

// ViSP's own models, where Debian's package visp-images-data is installed.
TEST(Cao, ReadsTheModelsOfVisp) {
  const std::filesystem::path root = "/usr/share/visp-images-data/ViSP-images";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "visp-images-data is not installed";
  const Mesh cube = load_mesh(root / "mbt/cube.cao", LengthUnit::Metre);
  EXPECT_EQ(cube.triangles.size(), 12u);
  EXPECT_NEAR(cube.diameter_m, std::sqrt(3.0) * 0.084, 1e-12);
  const Vector3d centre = 0.5 * (cube.box_min_m + cube.box_max_m);
  for (std::size_t i = 0; i < cube.triangles.size(); ++i)
    EXPECT_GT(cube.face_normals[i].dot(cube.vertices_m[cube.triangles[i][0]] - centre), 0);
  EXPECT_EQ(load_mesh(root / "mbt/cube_and_cylinder.cao", LengthUnit::Metre).triangles.size(),
            12u + 128);
  // 18, of which three are divided where corners of others lie on their sides.
  EXPECT_EQ(load_mesh(root / "mbt-depth/castel/chateau.cao", LengthUnit::Metre).triangles.size(),
            21u);
  EXPECT_EQ(
      load_mesh(root / "mbt-cao/cylinder_cao_model_windows_line_ending.cao", LengthUnit::Metre)
          .triangles.size(),
      192u);
}

}  // namespace
}  // namespace edgescout::test
