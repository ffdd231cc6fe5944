// Internal to host/io: triangles as they stand in a file, in the file's unit. make_mesh cleans
// them.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace edgescout {

struct RawMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::optional<double> metres_per_unit;  // as the file or its format says
};

// Each throws InputError naming the file and the error in it. For a file of n bytes each asks for
// at most 64 n + 64 MiB of memory.
RawMesh read_stl(const std::filesystem::path& file);
RawMesh read_ply(const std::filesystem::path& file);
RawMesh read_obj(const std::filesystem::path& file);
RawMesh read_cao(const std::filesystem::path& file);
RawMesh read_off(const std::filesystem::path& file);

// Reads glTF (.gltf, .glb), 3MF and COLLADA (.dae) by assimp, with the transforms of nodes.
// InputError: as above; the file with what it refers to is larger than 256 MiB, unpacked.
RawMesh read_scene(const std::filesystem::path& file);

// Triangulates a simple, (nearly) planar polygon by ear clipping. `corners` are indices into
// `vertices`. The triangles have the polygon's orientation. If the polygon crosses itself, the rest
// that has no ear becomes a fan.
void triangulate(const std::vector<int>& corners, const std::vector<Eigen::Vector3d>& vertices,
                 std::vector<std::array<int, 3>>& triangles);

// Adds polygons, each given by the number of its corners and these, counted from `first_index`.
// InputError naming `source` and the polygon: a corner is no vertex, or there are more than 20,000.
void add_polygons(std::span<const int> counted_corners, int first_index, const std::string& source,
                  RawMesh& mesh);

}  // namespace edgescout
