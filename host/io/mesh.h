// Reads triangle meshes: STL, PLY, OBJ, OFF and ViSP's `.cao`; glTF, 3MF and COLLADA by assimp.
//
// Public header.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

enum class LengthUnit { Millimetre, Centimetre, Metre, Inch };

// Returns the unit of a word: "mm", "cm", "m" or "in". InputError: another word.
LengthUnit length_unit(const std::string& word);
double metres_per(LengthUnit unit);

// Reads a mesh, converts it to metres and repairs it as make_mesh does. The given unit decides.
// Without one the file's own is used: of glTF (m), 3MF and COLLADA. If both differ, a warning is
// logged; so is a diameter outside 5 mm..5 m, and what is left out of a file. Nodes are placed by
// their transforms; the axes stay those of the file. InputError: the file is missing, unreadable,
// truncated or of unknown type; no unit is known; the count in an STL's header disagrees with the
// file's size; there is no triangle; a corner is not finite or beyond 1e9 m; an index is out of
// range; a glTF, 3MF or COLLADA file has more than 256 MiB, unpacked.
Mesh load_mesh(const std::filesystem::path& file, std::optional<LengthUnit> unit = {});

// Makes a mesh of raw triangles. `name` appears in errors. Computes normals, box and diameter. A
// mesh without defects keeps its triangles and vertices; otherwise, with lengths as shares of the
// diameter:
//   vertices within 1e-5                          are welded
//   duplicates and triangles at most 1e-5 high    are dropped; what was beside them is joined
//   open borders that face each other within 3e-3 are joined: loose triangles, T-junctions, seams
//   neighbours with opposite windings             are made consistent; closed parts turn outwards
// Vertices that no triangle uses are dropped. InputError: as load_mesh, or nothing is left.
Mesh make_mesh(std::string name, std::vector<Eigen::Vector3d> vertices_m,
               std::vector<std::array<int, 3>> triangles);

// Returns the mesh of make_mesh from its vertices and triangles, which stay as they are.
// InputError: as make_mesh.
Mesh restore_mesh(std::string name, std::vector<Eigen::Vector3d> vertices_m,
                  std::vector<std::array<int, 3>> triangles);

// Writes BOP's model format, atomically: binary little-endian PLY in millimetres, float vertices.
void save_ply_mm(const Mesh& mesh, const std::filesystem::path& file);

}  // namespace edgescout
