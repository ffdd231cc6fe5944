// The same box as many programs write it.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/io/mesh.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

const Triangles PART = box(30, 40, 120);

std::string substituted(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

Mesh load_mm(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  return load_mesh(folder.write(name, content), LengthUnit::Millimetre);
}

std::vector<std::array<double, 3>> sorted_mm(const Mesh& mesh) {
  std::vector<std::array<double, 3>> rows;
  for (const Vector3d& x : mesh.vertices_m)
    rows.push_back({std::round(1e6 * x.x()), std::round(1e6 * x.y()), std::round(1e6 * x.z())});
  std::ranges::sort(rows);
  return rows;
}

double volume_m3(const Mesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six += mesh.vertices_m[a].dot(mesh.vertices_m[b].cross(mesh.vertices_m[c]));
  return six / 6;
}

void expect_box(const Mesh& mesh) {
  const Triangles control = box(0.03, 0.04, 0.12);
  EXPECT_EQ(sorted_mm(mesh), sorted_mm(make_mesh("c", control.vertices, control.triangles)));
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(volume_m3(mesh), 0.03 * 0.04 * 0.12, 1e-10);
}

// The mesh must be the box, and `warnings` are logged.
void expect_box(const std::string& name, const std::string& content, std::size_t warnings = 0) {
  SCOPED_TRACE(name + ": " + content.substr(0, 60));
  CollectedLog log;
  try {
    expect_box(load_mm(name, content));
  } catch (const InputError& error) {
    ADD_FAILURE() << error.what();
  }
  EXPECT_EQ(log.messages.size(), warnings) << (warnings ? "" : log.messages[0].second);
}

void expect_refused(const std::string& name, const std::string& content,
                    std::initializer_list<std::string> words) {
  SCOPED_TRACE(name);
  expect_input_error([&] { load_mm(name, content); }, words);
}

TEST(StlDialects, ReadsWhatCommonWritersMakeOfTheWords) {
  const std::string text = ascii_stl(PART);
  std::string upper = text;
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return std::toupper(c); });
  expect_box("a.stl", upper);
  expect_box("a.stl", substituted(text, "endsolid", "end solid"));
  expect_box("a.stl",
             substituted(substituted(text, "endloop", "end loop"), "endfacet", "end facet"));
  expect_box("a.stl", substituted(text, "\n", "\r\n"));
  expect_box("a.stl", substituted(text, "\n", "\r"));
  expect_box("a.stl", substituted(text, "\n", " \t\n"));
  expect_box("a.stl", "\xEF\xBB\xBF" + text);
  expect_box("a.stl", "\n  " + text + std::string("\0\0\x1a", 3));
  expect_box("a.stl", substituted(text, "solid box", "solid"));
  expect_box("a.stl",
             substituted(text, "solid box\nfacet", "solid a facet, \xE4\ncolor 1 0 0\nfacet"));
}

TEST(StlDialects, ReadsAFileOfOneLine) {
  const std::string line = substituted(ascii_stl(PART), "\n", " ");
  expect_box("a.stl", line);
  expect_box("a.stl", substituted(line, "solid box", "solid"));
  expect_box("a.stl", substituted(line, "solid box", "solid the facet of a box"));
  expect_refused("a.stl", line + line, {"line 1", "one solid in a line"});
}

TEST(StlDialects, ReadsNoNormal) {
  const std::string text = ascii_stl(PART);
  for (const char* normal :
       {"nan nan nan", "-1.#IND 1.#QNAN -1.#IND", "-nan(ind) 0 0", "0,0 0 1", ""})
    expect_box("a.stl", substituted(text, "0 0 0\n outer", std::string(normal) + "\n outer"));
  expect_box("a.stl", substituted(text, "normal 0 0 0", ""));
  expect_refused("a.stl", substituted(text, "normal 0 0 0\n outer loop", "normal 0 0 0 0 0"),
                 {"line 2", "outer loop"});
}

TEST(StlDialects, ReadsSeveralSolidsAndPolygons) {
  const std::string text = ascii_stl(PART);
  const std::size_t middle = text.find("facet normal", text.size() / 2);
  expect_box("a.stl", text.substr(0, middle) + "endsolid box\n\nsolid b\n" + text.substr(middle));
  const std::string quad =
      "solid q\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
      "vertex 0 1 0\nendloop\nendfacet\nendsolid\n";
  EXPECT_EQ(load_mm("q.stl", quad).triangles.size(), 2u);
  expect_refused("q.stl", substituted(quad, "vertex 1 1 0\nvertex 0 1 0\n", ""),
                 {"vertex", "endloop"});
}

TEST(StlDialects, ReadsEveryFormOfANumber) {
  const std::string text = ascii_stl(PART);
  for (const char* thirty :
       {"3.000000e+01", "3.0E+001", "+30.", "0.3D+02", "3d1", "30.0000000000000"})
    expect_box("a.stl", substituted(text, "30.000000", thirty));
  expect_box("a.stl", substituted(text, " 0.000000", " -1e-400"));
  expect_refused("a.stl", substituted(text, "30.000000", "30,0"),
                 {"30,0", "decimal point", "line"});
  expect_refused("a.stl", substituted(text, "30.000000", "1.#QNAN"), {"vertex", "not finite"});
  expect_refused("a.stl", substituted(text, "30.000000", "1e999"), {"vertex", "not finite"});
  expect_refused("a.stl", substituted(text, "30.000000", "3O"), {"3O", "a number"});
}

TEST(StlDialects, ReadsBinaryWithColoursAndPadding) {
  std::string bytes = binary_stl(PART);
  const std::string magics = "COLOR=\x80\x80\x80\xff,MATERIAL=\x80\x80\x80\xff\x80\x80\x80\xff";
  bytes.replace(0, magics.size(), magics);
  for (std::size_t at = 84 + 48; at < bytes.size(); at += 50) bytes[at + 1] = '\x8f';
  expect_box("c.stl", bytes);
  expect_box("c.stl", bytes + "x", 1);
  expect_box("c.stl", bytes + std::string(61, 'x'), 1);
  expect_box("c.stl", bytes + std::string(100, '\0'), 1);
  bytes.replace(0, 5, "solid");
  expect_box("c.stl", bytes);
  expect_box("c.stl", bytes + "\n", 1);
  expect_refused("c.stl", bytes.substr(0, bytes.size() - 1), {"truncated"});
  const std::string text = ascii_stl(PART);
  expect_refused("a.stl", text.substr(0, text.size() - 14), {"truncated"});
}

// Binary PLY of either byte order with doubles and, before and behind what is read, other data.
template <typename T>
void put_number(std::string& bytes, T value, bool big) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string binary_ply(bool big, const std::string& line_end) {
  std::string text =
      std::string("ply\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\ncomment end_header of element face 3\nobj_info a b\n"
      "element camera 1\nproperty float64 view_px\nproperty list uint8 int16 steps\n"
      "element vertex 8\nproperty uint8 red\nproperty float64 x\nproperty float64 y\n"
      "property list uint16 float32 near\nproperty float64 z\nproperty int64 label\n"
      "element face 12\nproperty list ushort float texcoord\n"
      "property list int8 uint32 vertex_index\nproperty char flags\n"
      "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  std::string bytes = substituted(text, "\n", line_end);
  put_number(bytes, 1.0, big), put_number(bytes, std::uint8_t{2}, big);
  put_number(bytes, std::int16_t{-1}, big), put_number(bytes, std::int16_t{5}, big);
  for (const Vector3d& x : PART.vertices) {
    put_number(bytes, std::uint8_t{7}, big), put_number(bytes, x.x(), big),
        put_number(bytes, x.y(), big);
    put_number(bytes, std::uint16_t{1}, big), put_number(bytes, 0.5f, big),
        put_number(bytes, x.z(), big);
    put_number(bytes, std::int64_t{-9}, big);
  }
  for (const auto& triangle : PART.triangles) {
    put_number(bytes, std::uint16_t{1}, big), put_number(bytes, 0.25f, big),
        put_number(bytes, std::int8_t{3}, big);
    for (const int v : triangle) put_number(bytes, std::uint32_t(v), big);
    put_number(bytes, std::int8_t{-1}, big);
  }
  put_number(bytes, std::int32_t{0}, big), put_number(bytes, std::int32_t{1}, big);
  return bytes;
}

TEST(PlyDialects, ReadsBothByteOrdersAllTypesAndOtherElements) {
  for (const bool big : {false, true})
    for (const char* line_end : {"\n", "\r\n", "\r"})
      expect_box("a.ply", binary_ply(big, line_end));
  const std::string bytes = binary_ply(false, "\n");
  expect_box("a.ply", bytes + "\n", 1);
  expect_refused("a.ply", bytes + std::string(100, 'x'), {"more data"});
  expect_refused("a.ply", bytes.substr(0, bytes.size() - 1), {"truncated"});
}

TEST(PlyDialects, ReadsTextAsCommonWritersMakeIt) {
  const std::string text = ascii_ply(PART);
  expect_box("a.ply", substituted(text, "\n", "\r\n"));
  expect_box("a.ply", substituted(text, "\n", "\r"));
  expect_box("a.ply", substituted(text, "\n", " \n"));
  expect_box("a.ply", substituted(text, "vertex_indices", "vertex_index"));
  expect_box("a.ply", "\xEF\xBB\xBF" + text);
  expect_box("a.ply",
             substituted(substituted(text, "float", "float32"), "uchar int", "uint8 uint32"));
  expect_box("a.ply", substituted(text, "ply\nformat", "ply\ncomment TextureFile a.png\nformat"));
  // MeshLab's texture at the corners, with numbers that are not integers.
  std::string wedges =
      substituted(text, "indices\n", "indices\nproperty list uchar float texcoord\n");
  const std::size_t faces = wedges.find("\n3 ") + 1;
  expect_box("a.ply", wedges.substr(0, faces) +
                          substituted(wedges.substr(faces), "\n", " 6 0 0 0.5 0.25 1 1\n"));
  expect_box("a.ply", text + std::string(1, '\x1a'));
}

TEST(PlyDialects, ReadsVerticesThatAreNotUsedWhateverTheyHold) {
  std::string text = substituted(ascii_ply(PART), "vertex 8", "vertex 10");
  text.insert(text.find("\n3 ") + 1, "nan -nan(ind) 1.#QNAN\ninf 1e999 -1.#IND\n");
  expect_box("a.ply", text);
}

TEST(PlyDialects, ReadsPolygonsAndStrips) {
  const std::string text = ascii_ply(PART), head = text.substr(0, text.find("element face")),
                    rows = text.substr(text.find("end_header\n") + 11);
  const std::string vertices = rows.substr(0, rows.find("\n3 ") + 1);
  expect_box("q.ply",
             head + "element face 6\nproperty list uchar int vertex_indices\nend_header\n" +
                 vertices + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n");
  // Round the box, then the two ends.
  const std::string strips = head +
                             "element tristrips 1\nproperty list int int vertex_indices\n"
                             "end_header\n" +
                             vertices + "20 0 4 2 6 3 7 1 5 0 4 -1 0 2 1 3 -1 4 5 6 7\n";
  expect_box("s.ply", strips);
  expect_refused("s.ply", substituted(strips, "-1 4 5 6 7", "-1 4 5 6 8"), {"tristrips", "8"});
}

TEST(PlyDialects, RejectsListsAndCountsThatCannotBe) {
  const std::string text = ascii_ply(PART);
  expect_refused("a.ply", substituted(text, "\n3 0 2 1", "\n-3 0 2 1"), {"list length", "-3"});
  expect_refused("a.ply", substituted(text, "\n3 0 2 1", "\n3 0 2 1.5"), {"list entry", "1.5"});
  expect_refused("a.ply", substituted(text, "vertex 8", "vertex 99999999"), {"99999999 of vertex"});
  expect_refused("a.ply", substituted(text, "ascii", "ascii_2"), {"ascii_2", "line 2"});
  expect_refused("a.ply", substituted(text, "format ascii 1.0\n", ""), {"format"});
  expect_refused("a.ply", substituted(text, "property float x", "property real x"),
                 {"real", "type"});
}

TEST(ObjDialects, ReadsEveryFormOfAFace) {
  const std::string text = obj_box(30, 40, 120);
  const std::string rows = text.substr(0, text.find("f ")) + "vt 0 0\nvn 0 0 1\n",
                    faces = text.substr(text.find("f "));
  const auto with = [&](const std::string& suffix) {
    std::string all;
    for (const char c : faces)
      all += std::string(1, c) + (std::isdigit(static_cast<unsigned char>(c)) ? suffix : "");
    return rows + all;
  };
  for (const char* suffix : {"", "/1", "//1", "/1/1", "//-1"}) expect_box("a.obj", with(suffix));
  std::string negative = faces;
  for (char i = '1'; i <= '8'; ++i)
    negative =
        substituted(negative, std::string(" ") + i, " -" + std::string(1, char('9' - i + '0')));
  expect_box("a.obj", rows + negative);
  expect_box("a.obj", faces + rows);
  expect_box("a.obj", substituted(text, "f 1 3", "f 1 \\\n 3 "));
  expect_box("a.obj", substituted(substituted(text, "f 1 3", "f 1 \\\n 3 "), "\n", "\r\n"));
}

TEST(ObjDialects, ReadsPastGroupsColoursMaterialsAndComments) {
  const std::string text = obj_box(30, 40, 120);
  expect_box("a.obj", substituted(text, "\n", "\r"));
  expect_box("a.obj", "\xEF\xBB\xBFmtllib none.mtl\n" + text);
  expect_box("a.obj", substituted(text, "f 1 3", "g a b\nusemtl steel\ns off\nl 1 2\np 1\nf 1 3"));
  expect_box("a.obj", substituted(text, "\nf", " # comment\nf"));
  expect_box("a.obj", substituted(text, "120.000000\n", "120.000000 0.5 0.5 0.5\n"));
  expect_box("a.obj", substituted(text, "120.000000\n", "120.000000 2.0\n"));
  expect_box("a.obj", substituted(text, "f 1 3", "v nan 1.#QNAN inf\nf 1 3"));
  expect_box("a.obj", text + "cstype bezier\nsurf 0 1 0 1 1 2 3 4\nend\n", 1);
}

TEST(ObjDialects, NamesTheLineOfWhatIsWrong) {
  const std::string text = obj_box(30, 40, 120);
  expect_refused("a.obj", substituted(text, "40.000000", "40,0"),
                 {"line 5", "40,0", "decimal point"});
  expect_refused("a.obj", text + "f 1 2 x\n", {"line 17", "x"});
  expect_refused("a.obj", text + "f 0 1 2\n", {"line 17", "0", "-8"});
  expect_refused("a.obj", text + "f 1 2 -9\n", {"line 17", "-9"});
  expect_refused("a.obj", text + "f 1 2\n", {"line 17", "three corners"});
  expect_refused("a.obj", substituted(text, "f 1 3", "v 1 2\nf 1 3"), {"line 11", "coordinate"});
  std::string many = text + "f";
  for (int i = 0; i < 20'001; ++i) many += " 1";
  expect_refused("a.obj", many + "\n", {"20001 corners", "20000"});
}

TEST(OffDialects, ReadsColoursCommentsAndFormsOfTheHeader) {
  std::string text = "OFF\n8 6 12\n";
  for (const Vector3d& x : PART.vertices) text += row(x);
  text += "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  expect_box("a.off", text);
  expect_box("a.off", substituted(text, "OFF\n8 6 12", "# b\nOFF 8 6 # c\n"));
  expect_box("a.off",
             substituted(substituted(text, "OFF", "COFF"), "120.000000\n", "120.0 255 0 0 1\n"));
  expect_box("a.off", substituted(text, "1 3 7 5\n", "1 3 7 5 0.1 0.2 0.3\n"));
  expect_box("a.off", substituted(text, "OFF\n8 6 12", "OFF8 6 12"));
  expect_box("a.off", substituted(text, "OFF\n8 6 12", "8 6 12"));
  expect_refused("a.off", text.substr(0, text.size() - 12), {"truncated"});
  expect_refused("a.off", text + "3 0 1 2\n", {"the end of the file"});
  expect_refused("a.off", substituted(text, "3 7 5", "3 7 8"), {"face 5", "8"});
  expect_refused("a.off", substituted(text, "OFF", "4OFF"), {"three dimensions"});
  expect_refused("a.off", "OFF BINARY\n8", {"BINARY"});
}

}  // namespace
}  // namespace edgescout::test
