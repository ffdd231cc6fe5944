// Reads triangle meshes: STL and PLY (binary, ASCII), OBJ (by assimp) and ViSP's `.cao`.
//
// Public header.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

enum class LengthUnit { Millimetre, Centimetre, Metre, Inch };

// "mm", "cm", "m" or "in". InputError: another word.
LengthUnit length_unit(const std::string& word);
double metres_per(LengthUnit unit);

// Reads a mesh and converts it to metres. Welds vertices closer than 1e-6 of the diameter, drops
// degenerate and duplicate triangles, and computes normals, box and diameter. A diameter outside
// 5 mm..5 m is logged as a warning. InputError: the file is missing, unreadable, truncated or of
// unknown type; the count in an STL's header disagrees with the file's size; there is no triangle;
// a vertex is not finite or beyond 1e9 m; an index is out of range.
Mesh load_mesh(const std::filesystem::path& file, LengthUnit unit);

// Welds, cleans and completes a mesh of raw triangles, as load_mesh does after reading. `name`
// appears in errors. Vertices that no triangle uses are dropped.
Mesh make_mesh(std::string name, std::vector<Eigen::Vector3d> vertices_m,
               std::vector<std::array<int, 3>> triangles);

// Writes BOP's model format, atomically: binary little-endian PLY in millimetres, float vertices.
void save_ply_mm(const Mesh& mesh, const std::filesystem::path& file);

}  // namespace edgescout
