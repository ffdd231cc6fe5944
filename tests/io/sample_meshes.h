// The same box in every format, and files built from pieces.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace edgescout::test {

struct Triangles {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

// [0, x] x [0, y] x [0, z], counter-clockwise seen from outside.
inline Triangles box(double x, double y, double z) {
  Triangles b;
  for (int i = 0; i < 8; ++i) b.vertices.push_back({i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0});
  b.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return b;
}

inline void append_float(std::string& bytes, double value) {
  const float single = static_cast<float>(value);
  bytes.append(reinterpret_cast<const char*>(&single), sizeof single);
}

inline std::string binary_stl(const Triangles& mesh, std::uint32_t claimed_count) {
  std::string bytes(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&claimed_count), sizeof claimed_count);
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append_float(bytes, 0);
    for (int v : triangle)
      for (int axis = 0; axis < 3; ++axis) append_float(bytes, mesh.vertices[v][axis]);
    bytes.append(2, '\0');
  }
  return bytes;
}
inline std::string binary_stl(const Triangles& mesh) {
  return binary_stl(mesh, static_cast<std::uint32_t>(mesh.triangles.size()));
}

inline std::string row(const Eigen::Vector3d& x) {
  return std::to_string(x.x()) + " " + std::to_string(x.y()) + " " + std::to_string(x.z()) + "\n";
}

inline std::string ascii_stl(const Triangles& mesh) {
  std::string text = "solid box\n";
  for (const auto& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (int v : triangle) text += "  vertex " + row(mesh.vertices[v]);
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

inline std::string ascii_ply(const Triangles& mesh) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " +
                     std::to_string(mesh.vertices.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(mesh.triangles.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& x : mesh.vertices) text += row(x);
  for (const auto& [a, b, c] : mesh.triangles)
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  return text;
}

// A box with quadrilaterals.
inline std::string obj_box(double x, double y, double z) {
  std::string text = "# box\no box\n";
  for (const auto& v : box(x, y, z).vertices) text += "v " + row(v);
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

inline std::string cao_box(double x, double y, double z) {
  std::string text = "V1\n8 # points\n";
  for (const auto& v : box(x, y, z).vertices) text += row(v);
  return text +
         "0\n0\n6\n4 0 2 3 1\n4 4 5 7 6 name=top\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 "
         "5\n0\n0\n";
}

}  // namespace edgescout::test
