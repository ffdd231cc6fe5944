// Reads glTF, 3MF and COLLADA by assimp.
#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>

#include "host/io/files.h"
#include "host/io/one_line.h"
#include "host/io/raw_mesh.h"
#include "host/io/scene_text.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// Opens files for reading until they are too large together.
class BoundedFiles : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    std::error_code unknown;
    if (!fs::is_regular_file(name, unknown) || std::string_view(mode).find('r') != 0)
      return nullptr;
    bytes_ += fs::file_size(name, unknown);
    if (bytes_ > most_scene_bytes) return nullptr;
    return DefaultIOSystem::Open(name, mode);
  }
  bool too_large() const { return bytes_ > most_scene_bytes; }

 private:
  std::uintmax_t bytes_ = 0;
};

Eigen::Matrix4d to_matrix(const aiMatrix4x4& m) {
  Eigen::Matrix4d result;
  result << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return result;
}

class SceneReader {
 public:
  SceneReader(const aiScene& scene, const std::string& source) : scene_(scene), source_(source) {}

  RawMesh read() {
    struct Placed {
      const aiNode* node;
      Eigen::Matrix4d scene_from_parent;
    };
    std::vector<Placed> open{{scene_.mRootNode, Eigen::Matrix4d::Identity()}};
    while (!open.empty()) {
      const Placed placed = open.back();
      open.pop_back();
      if (!placed.node) continue;
      const Eigen::Matrix4d scene_from_node =
          placed.scene_from_parent * to_matrix(placed.node->mTransformation);
      for (unsigned i = 0; i < placed.node->mNumMeshes; ++i)
        append(*scene_.mMeshes[placed.node->mMeshes[i]], scene_from_node);
      for (unsigned i = placed.node->mNumChildren; i > 0; --i)
        open.push_back({placed.node->mChildren[i - 1], scene_from_node});
    }
    return std::move(mesh_);
  }

 private:
  void append(const aiMesh& part, const Eigen::Matrix4d& scene_from_part) {
    const int base = static_cast<int>(mesh_.vertices.size());
    const bool is_mirrored = scene_from_part.topLeftCorner<3, 3>().determinant() < 0;
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& x = part.mVertices[i];
      mesh_.vertices.push_back((scene_from_part * Eigen::Vector4d(x.x, x.y, x.z, 1)).head<3>());
    }
    std::vector<int> corners;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      corners.clear();
      for (unsigned k = 0; k < part.mFaces[i].mNumIndices; ++k) {
        const unsigned index = part.mFaces[i].mIndices[k];
        if (index >= part.mNumVertices)
          throw InputError(source_, "face " + std::to_string(i),
                           "vertex index " + std::to_string(index),
                           "an index below " + std::to_string(part.mNumVertices));
        corners.push_back(base + static_cast<int>(index));
      }
      if (is_mirrored) std::ranges::reverse(corners);
      triangulate(corners, mesh_.vertices, mesh_.triangles);
    }
  }

  const aiScene& scene_;
  const std::string& source_;
  RawMesh mesh_;
};

}  // namespace

RawMesh read_scene(const fs::path& file) {
  const std::string source = file.string();
  const double metres_per_unit = check_scene_text(file);
  Assimp::Importer importer;
  auto* files = new BoundedFiles;  // the importer deletes it
  importer.SetIOHandler(files);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = nullptr;
  std::string failure;
  try {
    scene = importer.ReadFile(source, 0);
    failure = importer.GetErrorString();
  } catch (const std::exception& error) {
    failure = error.what();
  }
  if (files->too_large())
    throw InputError(source, "size", "more than 256 MiB with what it refers to",
                     "a smaller file, or STL or PLY");
  if (!scene) throw InputError(source, "mesh", one_line(failure), "a file that assimp reads");
  RawMesh mesh = SceneReader(*scene, source).read();
  mesh.metres_per_unit = metres_per_unit;
  if (is_collada(file))  // assimp has converted it to metres
    for (Eigen::Vector3d& x : mesh.vertices) x /= metres_per_unit;
  return mesh;
}

}  // namespace edgescout
