// Internal to host/io: triangles as a file gives them, in the file's unit, before make_mesh cleans
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

// Each throws InputError naming the file and what is wrong with it.
RawMesh read_stl(const std::filesystem::path& file);
RawMesh read_ply(const std::filesystem::path& file);
RawMesh read_cao(const std::filesystem::path& file);
RawMesh read_obj(const std::filesystem::path& file);

// Cuts the ears off a simple, (nearly) planar polygon; corners are indices into `vertices`. The
// triangles keep the polygon's sense. What a self-crossing polygon leaves over becomes a fan.
void triangulate(const std::vector<int>& corners, const std::vector<Eigen::Vector3d>& vertices,
                 std::vector<std::array<int, 3>>& triangles);

}  // namespace edgescout
