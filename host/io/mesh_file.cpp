// Chooses the reader of a mesh file and applies the unit. Reads OBJ by assimp. Writes PLY.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cstdint>

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

void append(const aiMesh& part, RawMesh& mesh, const std::string& source) {
  const int base = static_cast<int>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i)
    mesh.vertices.emplace_back(part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z);
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    std::vector<int> corners;
    for (unsigned k = 0; k < part.mFaces[i].mNumIndices; ++k) {
      const unsigned index = part.mFaces[i].mIndices[k];
      if (index >= part.mNumVertices)
        throw InputError(source, "face " + std::to_string(i),
                         "vertex index " + std::to_string(index),
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
  if (extension == ".ply") return read_ply(file);
  if (extension == ".obj") return read_obj(file);
  throw InputError(file.string(), "file type", extension.empty() ? "no extension" : extension,
                   ".stl, .ply, .obj or .cao");
}

template <typename T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

RawMesh read_obj(const std::filesystem::path& file) {
  const std::string bytes = read_file(file), source = file.string();
  Assimp::Importer importer;
  const aiScene* scene = nullptr;
  std::string failure;
  try {
    scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "obj");
    failure = importer.GetErrorString();
  } catch (const std::exception& error) {
    failure = error.what();
  }
  if (!scene) throw InputError(source, "mesh", failure, "an OBJ file with faces");
  RawMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], mesh, source);
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
