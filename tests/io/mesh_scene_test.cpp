// glTF, 3MF and COLLADA files of the same box.
#include <gtest/gtest.h>
#include <minizip/zip.h>

#include <cmath>

#include "host/io/mesh.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

std::string mesh_bytes(const Triangles& mesh, double scale) {
  std::string bytes;
  for (const Vector3d& x : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) append_float(bytes, scale * x[axis]);
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle) bytes += {char(v), '\0'};
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[group >> shift & 63];
  }
  if (bytes.size() % 3) text.replace(text.size() - 1, 1, "=");
  if (bytes.size() % 3 == 1) text.replace(text.size() - 2, 1, "=");
  return text;
}

// A box of 30 x 40 x 120 mm in metres. `buffer` is what stands beside the buffer's length.
std::string gltf(const std::string& buffer, const std::string& node, double scale = 1e-3) {
  const auto corner = [&](double x, double y, double z) {
    return "[" + std::to_string(scale * x) + "," + std::to_string(scale * y) + "," +
           std::to_string(scale * z) + "]";
  };
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" +
         node + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" +
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":)" +
         corner(0, 0, 0) + R"(,"max":)" + corner(30, 40, 120) +
         R"(},{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)" +
         R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},)" +
         R"({"buffer":0,"byteOffset":96,"byteLength":72}],"buffers":[{"byteLength":168)" + buffer +
         "}]}";
}

std::string embedded(const std::string& node = "", double scale = 1e-3) {
  return gltf(R"(,"uri":"data:application/octet-stream;base64,)" +
                  base64(mesh_bytes(box(30, 40, 120), scale)) + "\"",
              node, scale);
}

std::string word32(std::size_t value) {
  const auto number = std::uint32_t(value);
  return std::string(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string glb() {
  std::string json = gltf("", ""), bytes = mesh_bytes(box(30, 40, 120), 1e-3);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return "glTF" + word32(2) + word32(12 + 8 + json.size() + 8 + bytes.size()) +
         word32(json.size()) + "JSON" + json + word32(bytes.size()) + std::string("BIN\0", 4) +
         bytes;
}

std::string model_3mf(const std::string& unit, double scale, const std::string& item) {
  const Triangles b = box(scale * 30, scale * 40, scale * 120);
  std::string text = "<?xml version=\"1.0\"?><model " + unit +
                     " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">"
                     "<resources><object id=\"1\" type=\"model\"><mesh><vertices>";
  for (const Vector3d& x : b.vertices)
    text += "<vertex x=\"" + std::to_string(x.x()) + "\" y=\"" + std::to_string(x.y()) + "\" z=\"" +
            std::to_string(x.z()) + "\"/>";
  text += "</vertices><triangles>";
  for (const auto& [i, j, k] : b.triangles)
    text += "<triangle v1=\"" + std::to_string(i) + "\" v2=\"" + std::to_string(j) + "\" v3=\"" +
            std::to_string(k) + "\"/>";
  return text + "</triangles></mesh></object></resources><build><item objectid=\"1\" " + item +
         "/></build></model>";
}

std::filesystem::path write_3mf(const TemporaryFolder& folder, const std::string& model) {
  const std::string package = "http://schemas.openxmlformats.org/package/2006/",
                    relations =
                        "<?xml version=\"1.0\"?><Relationships xmlns=\"" + package +
                        "relationships\"><Relationship Target=\"/3D/3dmodel.model\" Id=\"r\" "
                        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
                        "</Relationships>",
                    types = "<?xml version=\"1.0\"?><Types xmlns=\"" + package +
                            "content-types\"><Default Extension=\"model\" "
                            "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\""
                            "/></Types>";
  std::filesystem::path file = folder.path() / "box.3mf";
  const zipFile zip = zipOpen(file.c_str(), APPEND_STATUS_CREATE);
  for (const auto& [name, content] :
       {std::pair<const char*, std::string>{"[Content_Types].xml", types},
        {"_rels/.rels", relations},
        {"3D/3dmodel.model", model}}) {
    zipOpenNewFileInZip(zip, name, nullptr, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, 6);
    zipWriteInFileInZip(zip, content.data(), unsigned(content.size()));
    zipCloseFileInZip(zip);
  }
  zipClose(zip, nullptr);
  return file;
}

std::string collada(const std::string& unit, double scale) {
  const Triangles b = box(scale * 30, scale * 40, scale * 120);
  std::string positions, corners;
  for (const Vector3d& x : b.vertices) positions += row(x);
  for (const auto& triangle : b.triangles)
    for (const int v : triangle) corners += std::to_string(v) + " ";
  return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\"><asset>" +
         unit +
         "<up_axis>Z_UP</up_axis></asset><library_geometries><geometry id=\"g\"><mesh>"
         "<source id=\"p\"><float_array id=\"a\" count=\"24\">" +
         positions +
         "</float_array><technique_common><accessor source=\"#a\" count=\"8\" stride=\"3\">"
         "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
         "<triangles count=\"12\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" +
         corners +
         "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
         "<visual_scene id=\"s\"><node id=\"n\"><instance_geometry url=\"#g\"/></node>"
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene>"
         "</COLLADA>";
}

// The box, from `min_mm` on along the given lengths of its sides.
void expect_placed(const Mesh& mesh, const Vector3d& min_mm = {0, 0, 0},
                   const Vector3d& sides_mm = {30, 40, 120}) {
  EXPECT_EQ(mesh.vertices_m.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_LT((1000 * mesh.box_min_m - min_mm).norm(), 1e-4) << 1000 * mesh.box_min_m.transpose();
  EXPECT_LT((1000 * mesh.box_max_m - min_mm - sides_mm).norm(), 1e-4);
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six += mesh.vertices_m[a].dot(mesh.vertices_m[b].cross(mesh.vertices_m[c]));
  EXPECT_NEAR(six / 6, 0.03 * 0.04 * 0.12, 1e-9);
}

TEST(Gltf, ReadsBuffersInsideBesideAndInGlb) {
  const TemporaryFolder folder;
  folder.write("box.bin", mesh_bytes(box(30, 40, 120), 1e-3));
  const std::string beside = gltf(R"(,"uri":"box.bin")", "");
  for (const auto& [name, content] : {std::pair<const char*, std::string>{"a.gltf", embedded()},
                                      {"b.gltf", beside},
                                      {"c.glb", glb()}}) {
    SCOPED_TRACE(name);
    const auto file = folder.write(name, content);
    CollectedLog log;
    expect_placed(load_mesh(file));
    expect_placed(load_mesh(file, LengthUnit::Metre));
    EXPECT_TRUE(log.messages.empty());
  }
}

TEST(Gltf, PlacesNodes) {
  const TemporaryFolder folder;
  const auto placed = [&](const std::string& node, double scale = 1e-3) {
    return load_mesh(folder.write("a.gltf", embedded(node, scale)));
  };
  expect_placed(placed(R"(,"scale":[0.001,0.001,0.001])", 1));
  expect_placed(placed(R"(,"translation":[0.01,0,0],"rotation":[0,0,0.70710678,0.70710678])"),
                {-30, 0, 0}, {40, 30, 120});
  expect_placed(placed(R"(,"scale":[-1,1,1])"), {-30, 0, 0});
}

// Many files hold millimetres, whatever the format says.
TEST(Gltf, TheGivenUnitDecides) {
  const TemporaryFolder folder;
  const auto file = folder.write("mm.gltf", embedded("", 1));
  CollectedLog log;
  expect_placed(load_mesh(file, LengthUnit::Millimetre));
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_NE(log.messages[0].second.find("mm.gltf: the file says that its unit is 1.0"),
            std::string::npos)
      << log.messages[0].second;
}

TEST(Gltf, RejectsWhatIsMissingCutOrCompressed) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& content,
                           std::initializer_list<std::string> words) {
    expect_input_error([&] { load_mesh(folder.write(name, content)); }, words);
  };
  refused("a.gltf", gltf(R"(,"uri":"none.bin")", ""), {"a.gltf", "none.bin"});
  const std::string whole = glb();
  refused("a.glb", whole.substr(0, whole.size() - 40), {"a.glb"});
  refused("a.glb", "", {"a.glb"});
  refused("a.gltf", "{\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}",
          {"a.gltf", "KHR_draco_mesh_compression", "not compressed"});
}

TEST(ThreeMf, ReadsItsUnitAndPlacesItems) {
  const TemporaryFolder folder;
  const auto placed = [&](const std::string& unit, double scale, const std::string& item = "") {
    return load_mesh(write_3mf(folder, model_3mf(unit, scale, item)));
  };
  expect_placed(placed("", 1));
  expect_placed(placed("unit=\"millimeter\"", 1));
  expect_placed(placed("unit='centimeter'", 0.1));
  expect_placed(placed("unit=\"meter\"", 0.001));
  expect_placed(placed("unit=\"micron\"", 1000));
  expect_placed(placed("", 1, "transform=\"0 1 0 -1 0 0 0 0 1 10 0 0\""), {-30, 0, 0},
                {40, 30, 120});
  expect_input_error([&] { placed("unit=\"parsec\"", 1); }, {"box.3mf", "unit", "parsec", "inch"});
  expect_input_error([&] { placed("", 1, "transform=\"1 0 0 0\""); },
                     {"box.3mf", "transform", "12"});
}

TEST(ThreeMf, RejectsWhatIsNoArchiveOrTooLarge) {
  const TemporaryFolder folder;
  const std::string whole = content_of(write_3mf(folder, model_3mf("", 1, "")));
  for (const std::size_t length : {std::size_t(0), whole.size() / 2, whole.size() - 10})
    expect_input_error([&] { load_mesh(folder.write("a.3mf", whole.substr(0, length))); },
                       {"a.3mf", "archive"});
  // The directory of the archive says 4 GB: its last entry has the size 24 bytes from the start.
  std::string bomb = whole;
  bomb.replace(bomb.rfind("PK\x01\x02") + 24, 4, "\xff\xff\xff\xfe");
  expect_input_error([&] { load_mesh(folder.write("a.3mf", bomb)); }, {"a.3mf", "size", "256 MiB"});
}

TEST(Collada, ReadsItsUnitAndKeepsItsAxes) {
  const TemporaryFolder folder;
  const std::string mm = "<unit name=\"millimeter\" meter=\"0.001\"/>";
  CollectedLog log;
  expect_placed(load_mesh(folder.write("a.dae", collada(mm, 1))));
  expect_placed(load_mesh(folder.write("a.dae", collada(mm, 1)), LengthUnit::Millimetre));
  expect_placed(load_mesh(folder.write("a.dae", collada("", 0.001))));
  EXPECT_TRUE(log.messages.empty());
  expect_placed(load_mesh(folder.write("a.dae", collada("", 1)), LengthUnit::Millimetre));
  EXPECT_EQ(log.messages.size(), 1u);
  expect_input_error([&] { load_mesh(folder.write("a.dae", "x")); }, {"a.dae"});
}

TEST(LoadMesh, AsksForTheUnitOfFormatsWithoutOne) {
  const TemporaryFolder folder;
  expect_input_error([&] { load_mesh(folder.write("a.stl", binary_stl(box(1, 2, 3)))); },
                     {"a.stl", "unit", "mm, cm, m or in"});
}

// A file that is larger than what assimp may read, without its content on the disk.
TEST(LoadMesh, RejectsLargeFilesForAssimpBeforeReadingThem) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.glb", glb());
  std::filesystem::resize_file(file, (256u << 20) + 1);
  expect_input_error([&] { load_mesh(file); }, {"a.glb", "size", "256 MiB"});
}

}  // namespace
}  // namespace edgescout::test
