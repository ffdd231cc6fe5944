// Internal to host/io: triangles as they stand in a file, in the file's unit. make_mesh cleans
// them.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace edgescout {

struct RawMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

// Each throws InputError naming the file and the error in it.
RawMesh read_stl(const std::filesystem::path& file);
RawMesh read_ply(const std::filesystem::path& file);
RawMesh read_cao(const std::filesystem::path& file);
RawMesh read_obj(const std::filesystem::path& file);

// Triangulates a simple, (nearly) planar polygon by ear clipping. `corners` are indices into
// `vertices`. The triangles have the polygon's orientation. If the polygon crosses itself, the rest
// that has no ear becomes a fan.
void triangulate(const std::vector<int>& corners, const std::vector<Eigen::Vector3d>& vertices,
                 std::vector<std::array<int, 3>>& triangles);

}  // namespace edgescout
