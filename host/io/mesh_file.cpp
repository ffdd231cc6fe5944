// Mesh files: which reader, which unit; PLY and OBJ through assimp; PLY out.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/mesh.h"
#include "host/io/raw_mesh.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

struct PlyCounts {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
};

// The counts of a PLY header, so that what assimp loaded can be compared with what the file promised.
PlyCounts ply_counts(const std::string& bytes, const std::string& source) {
  const std::size_t end = bytes.find("end_header");
  if (!bytes.starts_with("ply") || end == std::string::npos)
    throw InputError(source, "PLY header", "no whole header", "\"ply\" ... \"end_header\"");
  const auto count_of = [&](const std::string& element) {
    const std::size_t at = bytes.find("\nelement " + element + " ");
    std::uint64_t count = 0;
    if (at < end) std::from_chars(bytes.data() + at + element.size() + 10, bytes.data() + end, count);
    // An element takes at least a byte: a larger count is a lie that would only exhaust the memory.
    if (count > bytes.size())
      throw InputError(source, "PLY element " + element,
                       std::to_string(count) + " in a file of " + std::to_string(bytes.size()) + " bytes",
                       "a count that the file can hold");
    return count;
  };
  return {count_of("vertex"), count_of("face")};
}

void append(const aiMesh& part, RawMesh& mesh, const std::string& source) {
  const int base = static_cast<int>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i)
    mesh.vertices.emplace_back(part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z);
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    std::vector<int> corners;
    for (unsigned k = 0; k < part.mFaces[i].mNumIndices; ++k) {
      const unsigned index = part.mFaces[i].mIndices[k];
      if (index >= part.mNumVertices)
        throw InputError(source, "face " + std::to_string(i), "vertex index " + std::to_string(index),
                         "an index below " + std::to_string(part.mNumVertices));
      corners.push_back(base + static_cast<int>(index));
    }
    triangulate(corners, mesh.vertices, mesh.triangles);
  }
}

RawMesh read_raw(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  if (extension == ".stl") return read_stl(file);
  if (extension == ".cao") return read_cao(file);
  if (extension == ".ply" || extension == ".obj") return read_with_assimp(file);
  throw InputError(file.string(), "file type", extension.empty() ? "no extension" : extension,
                   ".stl, .ply, .obj or .cao");
}

template <typename T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

RawMesh read_with_assimp(const std::filesystem::path& file) {
  const std::string bytes = read_file(file), source = file.string();
  const bool is_ply = lower_extension(file) == ".ply";
  const PlyCounts promised = is_ply ? ply_counts(bytes, source) : PlyCounts{};
  Assimp::Importer importer;
  const aiScene* scene = nullptr;
  std::string failure;
  try {
    scene = importer.ReadFile(source, 0);
    failure = importer.GetErrorString();
  } catch (const std::exception& error) {  // bad_alloc on an absurd count
    failure = error.what();
  }
  if (!scene)
    throw InputError(source, "mesh", failure, "a whole " + std::string(is_ply ? "PLY" : "OBJ") + " file");
  RawMesh mesh;
  std::uint64_t faces = 0;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    append(*scene->mMeshes[i], mesh, source);
    faces += scene->mMeshes[i]->mNumFaces;
  }
  if (is_ply && (mesh.vertices.size() != promised.vertices || faces != promised.faces))
    throw InputError(
        source, "PLY counts",
        std::to_string(mesh.vertices.size()) + " vertices and " + std::to_string(faces) + " faces",
        std::to_string(promised.vertices) + " and " + std::to_string(promised.faces) + " as its header says");
  return mesh;
}

Mesh load_mesh(const std::filesystem::path& file, LengthUnit unit) {
  RawMesh raw = read_raw(file);
  for (Eigen::Vector3d& x : raw.vertices) x *= metres_per(unit);
  Mesh mesh = make_mesh(file.string(), std::move(raw.vertices), std::move(raw.triangles));
  mesh.name = file.stem().string();
  if (mesh.diameter_m < 0.005 || mesh.diameter_m > 5)
    log(LogLevel::Warning, file.string() + ": diameter " + std::to_string(mesh.diameter_m) +
                               " m is outside 0.005..5 m: is the unit right?");
  return mesh;
}

void save_ply_mm(const Mesh& mesh, const std::filesystem::path& file) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices_m.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& x : mesh.vertices_m)
    for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(1000 * x[axis]));
  for (const auto& triangle : mesh.triangles) {
    put(bytes, std::uint8_t{3});
    for (int v : triangle) put(bytes, std::int32_t{v});
  }
  write_file_atomically(file, bytes);
}

}  // namespace edgescout
