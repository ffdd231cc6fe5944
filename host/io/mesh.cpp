#include "host/io/mesh.h"

#include <Eigen/Geometry>
#include <utility>

#include "host/io/mesh_diameter.h"
#include "host/io/mesh_repair.h"
#include "kernels/error.h"

namespace edgescout {

using Eigen::Vector3d;

namespace {

// Larger than any mesh with a wrong unit. Keeps squares and grid indices far from overflow.
constexpr double max_coordinate_m = 1e9;

void require_usable(const std::string& name, const std::vector<Vector3d>& vertices, int v) {
  const auto field = [v] { return "vertex " + std::to_string(v); };
  if (!vertices[v].allFinite())
    throw InputError(name, field(), "a coordinate that is not finite", "finite numbers");
  if (vertices[v].cwiseAbs().maxCoeff() > max_coordinate_m)
    throw InputError(name, field(), "a coordinate beyond 1e9 m", "the size of a thing");
}

// Vertices that no triangle uses may be anything.
void require_usable(const std::string& name, const std::vector<Vector3d>& vertices,
                    const std::vector<std::array<int, 3>>& triangles) {
  const int count = static_cast<int>(vertices.size());
  if (count == 0 && !triangles.empty()) throw InputError(name, "vertices", "none", "at least 3");
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int v : triangles[i]) {
      if (v < 0 || v >= count)
        throw InputError(name, "triangle " + std::to_string(i), "vertex index " + std::to_string(v),
                         "0 to " + std::to_string(count - 1));
      require_usable(name, vertices, v);
    }
  if (triangles.empty()) throw InputError(name, "triangles", "none", "at least one");
}

Mesh complete(std::string name, RawMesh raw) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.vertices_m = std::move(raw.vertices);
  mesh.triangles = std::move(raw.triangles);
  mesh.box_min_m = mesh.box_max_m = mesh.vertices_m.front();
  for (const Vector3d& x : mesh.vertices_m) {
    mesh.box_min_m = mesh.box_min_m.cwiseMin(x);
    mesh.box_max_m = mesh.box_max_m.cwiseMax(x);
  }
  mesh.face_normals.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d& origin = mesh.vertices_m[a];
    mesh.face_normals.push_back(
        (mesh.vertices_m[b] - origin).cross(mesh.vertices_m[c] - origin).normalized());
  }
  mesh.diameter_m = largest_distance(mesh.vertices_m);
  return mesh;
}

}  // namespace

LengthUnit length_unit(const std::string& word) {
  if (word == "mm") return LengthUnit::Millimetre;
  if (word == "cm") return LengthUnit::Centimetre;
  if (word == "m") return LengthUnit::Metre;
  if (word == "in") return LengthUnit::Inch;
  throw InputError("unit: found \"" + word + "\", expected mm, cm, m or in");
}

double metres_per(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Millimetre:
      return 0.001;
    case LengthUnit::Centimetre:
      return 0.01;
    case LengthUnit::Metre:
      return 1.0;
    case LengthUnit::Inch:
      return 0.0254;
  }
  throw LogicError("metres_per: unknown unit");
}

Mesh make_mesh(std::string name, std::vector<Vector3d> vertices_m,
               std::vector<std::array<int, 3>> triangles) {
  require_usable(name, vertices_m, triangles);
  RawMesh mesh{std::move(vertices_m), std::move(triangles), {}};
  drop_unused_vertices(mesh);
  const double size_m = largest_distance(mesh.vertices);
  if (size_m > 0) repair_mesh(mesh, size_m);
  if (mesh.triangles.empty() || !(size_m > 0))
    throw InputError(name, "triangles", "only triangles without area, slivers or duplicates",
                     "at least one higher than 1e-5 of the diameter");
  return complete(std::move(name), std::move(mesh));
}

Mesh restore_mesh(std::string name, std::vector<Vector3d> vertices_m,
                  std::vector<std::array<int, 3>> triangles) {
  require_usable(name, vertices_m, triangles);
  for (int v = 0; v < static_cast<int>(vertices_m.size()); ++v) require_usable(name, vertices_m, v);
  return complete(std::move(name), {std::move(vertices_m), std::move(triangles), {}});
}

}  // namespace edgescout
