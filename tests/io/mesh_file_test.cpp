#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "host/io/mesh.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

struct NamedFile {
  std::string name;
  std::string content;
};

// A box of 30 x 40 x 120 mm in millimetres.
std::vector<NamedFile> boxes(const TemporaryFolder& folder) {
  const Triangles b = box(30, 40, 120);
  Triangles metres = box(0.03, 0.04, 0.12);
  save_ply_mm(make_mesh("box", metres.vertices, metres.triangles), folder.path() / "made.ply");
  std::string solid_stl = binary_stl(b);
  solid_stl.replace(0, 5, "solid");
  return {{"binary.stl", binary_stl(b)},
          {"solid.stl", solid_stl},
          {"ascii.STL", ascii_stl(b)},
          {"ascii.ply", ascii_ply(b)},
          {"binary.ply", content_of(folder.path() / "made.ply")},
          {"quads.obj", obj_box(30, 40, 120)},
          {"faces.cao", cao_box(30, 40, 120)}};
}

TEST(LoadMesh, ReadsTheSameBoxFromEveryFormat) {
  const TemporaryFolder folder;
  for (const NamedFile& file : boxes(folder)) {
    SCOPED_TRACE(file.name);
    const Mesh mesh = load_mesh(folder.write(file.name, file.content), LengthUnit::Millimetre);
    EXPECT_EQ(mesh.name, std::filesystem::path(file.name).stem());
    EXPECT_EQ(mesh.vertices_m.size(), 8u);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(mesh.diameter_m, 0.13, 1e-8);
    EXPECT_LT((mesh.box_max_m - Vector3d(0.03, 0.04, 0.12)).norm(), 1e-8);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      EXPECT_GT(mesh.face_normals[i].dot(mesh.vertices_m[mesh.triangles[i][0]] -
                                         Vector3d(0.015, 0.02, 0.06)),
                0);
  }
}

TEST(LoadMesh, ConvertsTheUnit) {
  const TemporaryFolder folder;
  const auto file = folder.write("box.stl", binary_stl(box(3, 4, 12)));
  EXPECT_NEAR(load_mesh(file, LengthUnit::Millimetre).diameter_m, 0.013, 1e-9);
  EXPECT_NEAR(load_mesh(file, LengthUnit::Centimetre).diameter_m, 0.13, 1e-8);
  EXPECT_NEAR(load_mesh(file, LengthUnit::Metre).diameter_m, 13, 1e-6);
  EXPECT_NEAR(load_mesh(file, LengthUnit::Inch).diameter_m, 13 * 0.0254, 1e-7);
}

TEST(LoadMesh, WarnsOfADiameterThatSuggestsAWrongUnit) {
  const TemporaryFolder folder;
  const auto file = folder.write("box.stl", binary_stl(box(3, 4, 12)));
  const auto warnings = [&](LengthUnit unit) {
    CollectedLog log;
    load_mesh(file, unit);
    for (const auto& [level, text] : log.messages) {
      EXPECT_EQ(level, LogLevel::Warning);
      EXPECT_NE(text.find("box.stl: diameter"), std::string::npos) << text;
    }
    return log.messages.size();
  };
  EXPECT_EQ(warnings(LengthUnit::Metre), 1u);
  EXPECT_EQ(warnings(LengthUnit::Centimetre), 0u);
  EXPECT_EQ(warnings(LengthUnit::Millimetre), 0u);
}

TEST(LoadMesh, RejectsAMissingFileAFolderAndAnUnknownType) {
  const TemporaryFolder folder;
  for (const char* extension : {".stl", ".ply", ".obj", ".cao"})
    expect_input_error(
        [&] { load_mesh(folder.path() / ("none" + std::string(extension)), LengthUnit::Metre); },
        {"none" + std::string(extension), "No such file"});
  std::filesystem::create_directory(folder.path() / "folder.stl");
  expect_input_error([&] { load_mesh(folder.path() / "folder.stl", LengthUnit::Metre); },
                     {"folder.stl", "a folder"});
  for (const char* name : {"part.step", "part.STP", "part.iges", "part.brep"})
    expect_input_error([&] { load_mesh(folder.write(name, "x"), LengthUnit::Metre); },
                       {name, "file type", ".cao", "export", "gmsh"});
  for (const char* name : {"step.stl", "step.ply", "step.obj"})
    expect_input_error(
        [&] {
          load_mesh(folder.write(name, "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\n"),
                    LengthUnit::Metre);
        },
        {name, "file type", "STEP", "export", "gmsh"});
  expect_input_error([&] { load_mesh(folder.write("part", "x"), LengthUnit::Metre); },
                     {"part", "no extension"});
}

TEST(LoadMesh, RejectsZeroTriangles) {
  const TemporaryFolder folder;
  const std::vector<NamedFile> empty{{"binary.stl", binary_stl({})},
                                     {"ascii.stl", ascii_stl({})},
                                     {"a.ply", ascii_ply({})},
                                     {"points.ply", ascii_ply({box(1, 1, 1).vertices, {}})},
                                     {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
                                     {"a.cao", "V1\n1\n0 0 0\n0\n0\n0\n"},
                                     {"empty.obj", ""}};
  for (const NamedFile& file : empty) {
    SCOPED_TRACE(file.name);
    expect_input_error([&] { load_mesh(folder.write(file.name, file.content), LengthUnit::Metre); },
                       {file.name});
  }
  for (const char* extension : {"stl", "ply", "cao"})
    expect_input_error(
        [&] { load_mesh(folder.write(std::string("empty.") + extension, ""), LengthUnit::Metre); },
        {"empty."});
}

TEST(LoadMesh, RejectsVerticesThatAreNotFinite) {
  const TemporaryFolder folder;
  for (double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Triangles b = box(1, 2, 3);
    b.vertices[6].z() = bad;
    const std::vector<NamedFile> files{
        {"binary.stl", binary_stl(b)}, {"ascii.stl", ascii_stl(b)}, {"ascii.ply", ascii_ply(b)}};
    for (const NamedFile& file : files) {
      SCOPED_TRACE(file.name);
      expect_input_error(
          [&] { load_mesh(folder.write(file.name, file.content), LengthUnit::Metre); },
          {file.name, "vertex", "not finite"});
    }
  }
  std::string cao = cao_box(1, 2, 3);
  cao.replace(cao.find("0.000000"), 8, "nan     ");
  expect_input_error([&] { load_mesh(folder.write("a.cao", cao), LengthUnit::Metre); },
                     {"a.cao", "vertex 0", "not finite"});
  std::string obj = obj_box(1, 2, 3);
  obj.replace(obj.find("0.000000"), 8, "nan     ");
  expect_input_error([&] { load_mesh(folder.write("a.obj", obj), LengthUnit::Metre); }, {"a.obj"});
}

TEST(LoadMesh, RejectsAnStlWhoseCountDisagreesWithItsSize) {
  const TemporaryFolder folder;
  const Triangles b = box(1, 1, 1);
  const auto load = [&](const std::string& bytes) {
    load_mesh(folder.write("lie.stl", bytes), LengthUnit::Metre);
  };
  expect_input_error([&] { load(binary_stl(b, 13)); },
                     {"lie.stl", "count", "13 triangles", "truncated"});
  expect_input_error([&] { load(binary_stl(b, 11)); },
                     {"lie.stl", "count", "11 triangles", "too small"});
  expect_input_error([&] { load(binary_stl(b, 0xffffffffu)); },
                     {"lie.stl", "count", "4294967295 triangles"});
  expect_input_error([&] { load(binary_stl(b, 0)); }, {"lie.stl", "count", "0 triangles"});
  expect_input_error([&] { load(binary_stl(b) + std::string(50, 'x')); }, {"lie.stl", "count"});
  expect_input_error([&] { load("short"); }, {"lie.stl", "5 bytes"});
  for (const std::string start : {"<!DOCTYPE html>", "ply\nformat ascii 1.0", "# exported"})
    expect_input_error([&] { load(start + std::string(200, '\n')); },
                       {"lie.stl", "text that begins with", start.substr(0, 3), "solid"});
}

TEST(LoadMesh, RejectsIndicesOutOfRangeAndCountsThatLie) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& name, const std::string& text) {
    load_mesh(folder.write(name, text), LengthUnit::Metre);
  };
  Triangles b = box(1, 1, 1);
  std::string more = ascii_ply(b), absurd = more;
  more.replace(more.find("face 12"), 7, "face 13");
  expect_input_error([&] { load("more.ply", more); }, {"more.ply"});
  absurd.replace(absurd.find("vertex 8"), 8, "vertex 4000000000");
  expect_input_error([&] { load("absurd.ply", absurd); }, {"absurd.ply", "4000000000"});
  b.triangles[4][1] = 8;
  expect_input_error([&] { load("index.ply", ascii_ply(b)); }, {"index.ply", "8"});
  b.triangles[4][1] = -1;
  expect_input_error([&] { load("index.ply", ascii_ply(b)); }, {"index.ply"});
  expect_input_error([&] { load("index.obj", obj_box(1, 1, 1) + "f 1 2 9\n"); }, {"index.obj"});
}

// Such rows take no byte of the file: 123 bytes could ask for any amount of memory.
TEST(LoadMesh, RejectsPlyRowsThatHoldNothing) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& text) {
    load_mesh(folder.write("rows.ply", text), LengthUnit::Metre);
  };
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
      "property float z\nelement ";
  expect_input_error([&] { load(head + "face 100000000\nend_header\n"); },
                     {"rows.ply", "vertex_indices"});
  expect_input_error([&] { load(head + "face 100000000\nproperty uchar red\nend_header\n"); },
                     {"rows.ply", "vertex_indices"});
  expect_input_error([&] { load(head + "edge 100000000\nend_header\n"); },
                     {"rows.ply", "100000000 of edge without a property"});
}

// Every truncated file either still holds a whole mesh or is an error. A file cut before the last
// triangle is always an error if the format has counts.
void cut_everywhere(const NamedFile& file, const TemporaryFolder& folder, bool counted) {
  constexpr std::size_t cuts = 100;
  int errors = 0;
  for (std::size_t i = 0; i < cuts; ++i) {
    const std::size_t length = file.content.size() * i / cuts;
    const auto cut = folder.write(file.name, std::string_view(file.content).substr(0, length));
    try {
      const Mesh mesh = load_mesh(cut, LengthUnit::Millimetre);
      EXPECT_LE(mesh.triangles.size(), 12u);
      if (counted) {
        EXPECT_EQ(mesh.triangles.size(), 12u) << file.name << " cut to " << length;
      }
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(file.name), std::string::npos) << error.what();
      ++errors;
    }
  }
  EXPECT_GT(errors, 10) << file.name;
}

TEST(LoadMesh, NeverCrashesOnATruncatedFile) {
  const TemporaryFolder folder;
  for (const NamedFile& file : boxes(folder))
    cut_everywhere(file, folder, file.name != "quads.obj");
}

// One byte changed: any mesh or an InputError, but nothing else.
TEST(LoadMesh, NeverCrashesOnADamagedFile) {
  const TemporaryFolder folder;
  std::mt19937 random(11);
  for (const NamedFile& file : boxes(folder)) {
    for (int round = 0; round < 200; ++round) {
      std::string damaged = file.content;
      damaged[random() % damaged.size()] = static_cast<char>(random());
      try {
        const Mesh mesh = load_mesh(folder.write(file.name, damaged), LengthUnit::Millimetre);
        EXPECT_EQ(mesh.face_normals.size(), mesh.triangles.size());
      } catch (const InputError& error) {
        EXPECT_FALSE(std::string(error.what()).empty());
      }
    }
  }
}

TEST(SavePlyMm, ReadsBackWithinSinglePrecision) {
  const TemporaryFolder folder;
  const Triangles b = box(0.0301, 0.0402, 0.1203);
  const Mesh mesh = make_mesh("b", b.vertices, b.triangles);
  save_ply_mm(mesh, folder.path() / "b.ply");
  const Mesh back = load_mesh(folder.path() / "b.ply", LengthUnit::Millimetre);
  ASSERT_EQ(back.triangles, mesh.triangles);
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i)
    EXPECT_LT((back.vertices_m[i] - mesh.vertices_m[i]).norm(), 1e-8);
}

}  // namespace
}  // namespace edgescout::test
