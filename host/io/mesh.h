// Triangle meshes from files: STL and PLY (binary, ASCII), OBJ (through assimp) and ViSP's `.cao`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

enum class LengthUnit { Millimetre, Centimetre, Metre, Inch };

// "mm", "cm", "m" or "in"; InputError otherwise.
LengthUnit length_unit(const std::string& word);
double metres_per(LengthUnit unit);

// Reads, converts to metres, welds vertices closer than 1e-6 of the diameter, drops degenerate and
// duplicate triangles and fills normals, box and diameter. A diameter outside 5 mm..5 m is logged
// as a warning. InputError: file missing, unreadable, truncated, of unknown type; an STL whose
// header's count disagrees with its size; zero triangles; a vertex not finite or beyond 1e9 m; an
// index out of range.
Mesh load_mesh(const std::filesystem::path& file, LengthUnit unit);

// Welds, cleans and completes a mesh made of raw triangles (what load_mesh does after reading).
// `name` appears in errors. Vertices that no triangle uses are dropped.
Mesh make_mesh(std::string name, std::vector<Eigen::Vector3d> vertices_m,
               std::vector<std::array<int, 3>> triangles);

// Binary little-endian PLY in millimetres, float vertices: BOP's model format. Written atomically.
void save_ply_mm(const Mesh& mesh, const std::filesystem::path& file);

}  // namespace edgescout
