// Chooses the reader of a mesh file and applies the unit. Writes PLY.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "host/core/log.h"
#include "host/core/option_names.h"
#include "host/io/files.h"
#include "host/io/lower_case.h"
#include "host/io/mesh.h"
#include "host/io/raw_mesh.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

constexpr const char* mesh_types = ".stl, .ply, .obj, .cao, .gltf, .glb, .3mf, .dae or .off";

[[noreturn]] void refuse_surfaces(const std::filesystem::path& file, const std::string& found) {
  throw InputError(file.string(), "file type", found + " (surfaces without triangles)",
                   std::string(mesh_types) + ": export an STL with the CAD program, or by gmsh " +
                       file.filename().string() + " -2 -clcurv 24 -format stl -bin -o " +
                       file.stem().string() + ".stl");
}

// A STEP file is one under any name. A file that is not there is refused for that.
void refuse_step(const std::filesystem::path& file) {
  constexpr std::string_view step = "ISO-10303-21";
  std::string start(64, '\0');
  open_file(file).read(start.data(), static_cast<std::streamsize>(start.size()));
  const std::size_t first = start.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first != std::string::npos && start.compare(first, step.size(), step) == 0)
    refuse_surfaces(file, "STEP");
}

RawMesh read_raw(const std::filesystem::path& file) {
  refuse_step(file);
  const std::string extension = lower_case(file.extension().string());
  if (extension == ".stl") return read_stl(file);
  if (extension == ".cao") return read_cao(file);
  if (extension == ".ply") return read_ply(file);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".off") return read_off(file);
  if (is_one_of(extension, {".gltf", ".glb", ".3mf", ".dae"})) return read_scene(file);
  if (is_one_of(extension, {".step", ".stp", ".iges", ".igs", ".brep", ".brp"}))
    refuse_surfaces(file, extension);
  throw InputError(file.string(), "file type", extension.empty() ? "no extension" : extension,
                   mesh_types);
}

// Metres per unit of the file. The given unit decides: many files of formats that have a unit hold
// numbers of another one.
double scale_of(const RawMesh& mesh, std::optional<LengthUnit> unit, const std::string& source) {
  const std::optional<double>& stated = mesh.metres_per_unit;
  if (!unit && !stated)
    throw InputError(source, option_name("unit"), "none in the file",
                     "the unit of its lengths: mm, cm, m or in");
  if (!unit) return *stated;
  const double given = metres_per(*unit);
  if (stated && std::abs(*stated / given - 1) > 1e-6)
    log(LogLevel::Warning, source + ": the file says that its unit is " + std::to_string(*stated) +
                               " m, the given unit is " + std::to_string(given) +
                               " m: the given one is used");
  return given;
}

template <typename T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

Mesh load_mesh(const std::filesystem::path& file, std::optional<LengthUnit> unit) {
  RawMesh raw = read_raw(file);
  const double scale = scale_of(raw, unit, file.string());
  for (Eigen::Vector3d& x : raw.vertices) x *= scale;
  Mesh mesh = make_mesh(file.string(), std::move(raw.vertices), std::move(raw.triangles));
  mesh.name = file.stem().string();
  if (mesh.diameter_m < 0.005 || mesh.diameter_m > 5)
    log(LogLevel::Warning, file.string() + ": diameter: found " + std::to_string(mesh.diameter_m) +
                               " m, expected 0.005 to 5 m: is the unit right (" +
                               option_name("unit") + ")?");
  return mesh;
}

void save_ply_mm(const Mesh& mesh, const std::filesystem::path& file) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.vertices_m.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(mesh.triangles.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& x : mesh.vertices_m)
    for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(1000 * x[axis]));
  for (const auto& triangle : mesh.triangles) {
    put(bytes, std::uint8_t{3});
    for (int v : triangle) put(bytes, std::int32_t{v});
  }
  write_file_atomically(file, bytes);
}

}  // namespace edgescout
