#include "host/io/mesh.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "host/io/mesh_diameter.h"
#include "kernels/error.h"

namespace edgescout {

using Eigen::Vector3d;

namespace {

// Fraction of the diameter. Two vertices closer than this are one; a triangle thinner than this has
// no usable normal.
constexpr double weld_share = 1e-6;
// Larger than any mesh with a wrong unit. Keeps squares and grid indices far from overflow.
constexpr double max_coordinate_m = 1e9;

void require_usable(const std::string& name, const std::vector<Vector3d>& vertices,
                    const std::vector<std::array<int, 3>>& triangles) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto field = [i] { return "vertex " + std::to_string(i); };
    if (!vertices[i].allFinite())
      throw InputError(name, field(), "a coordinate that is not finite", "finite numbers");
    if (vertices[i].cwiseAbs().maxCoeff() > max_coordinate_m)
      throw InputError(name, field(), "a coordinate beyond 1e9 m", "the size of a thing");
  }
  const int count = static_cast<int>(vertices.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int v : triangles[i])
      if (v < 0 || v >= count)
        throw InputError(name, "triangle " + std::to_string(i), "vertex index " + std::to_string(v),
                         "0 to " + std::to_string(count - 1));
}

// Keeps only vertices that a triangle uses: a stray point would make the box and the diameter
// wrong.
void drop_unused_vertices(std::vector<Vector3d>& vertices,
                          std::vector<std::array<int, 3>>& triangles) {
  std::vector<int> new_index(vertices.size(), -1);
  std::vector<Vector3d> used;
  for (auto& triangle : triangles)
    for (int& v : triangle) {
      if (new_index[v] < 0) {
        new_index[v] = static_cast<int>(used.size());
        used.push_back(vertices[v]);
      }
      v = new_index[v];
    }
  vertices = std::move(used);
}

// Stores vertices in a hash of cubes. A query examines only the cubes that its tolerance ball
// touches.
class WeldGrid {
 public:
  WeldGrid(const Vector3d& origin, double tolerance)
      : origin_(origin), tolerance_(tolerance), cell_(16 * tolerance) {}

  // Returns the index of a vertex within the tolerance of `x`. If there is none, adds `x`.
  int find_or_add(const Vector3d& x) {
    const Eigen::Array3d low = ((x - origin_).array() - tolerance_) / cell_;
    const Eigen::Array3d high = ((x - origin_).array() + tolerance_) / cell_;
    const Eigen::Array3i first = low.floor().cast<int>(), last = high.floor().cast<int>();
    for (int i = first.x(); i <= last.x(); ++i)
      for (int j = first.y(); j <= last.y(); ++j)
        for (int k = first.z(); k <= last.z(); ++k)
          if (const auto cell = cells_.find(key(i, j, k)); cell != cells_.end())
            for (int v : cell->second)
              if ((vertices_[v] - x).norm() <= tolerance_) return v;
    const Eigen::Array3i home = ((x - origin_).array() / cell_).floor().cast<int>();
    cells_[key(home.x(), home.y(), home.z())].push_back(static_cast<int>(vertices_.size()));
    vertices_.push_back(x);
    return static_cast<int>(vertices_.size()) - 1;
  }
  std::vector<Vector3d> take() { return std::move(vertices_); }

 private:
  // There are at most 1e6 * sqrt(3) / 16 cells per axis, so 21 bits hold each index (offset by one
  // for the border).
  static std::uint64_t key(int i, int j, int k) {
    const auto part = [](int n) { return static_cast<std::uint64_t>(n + 1) & 0x1fffff; };
    return part(i) | part(j) << 21 | part(k) << 42;
  }
  Vector3d origin_;
  double tolerance_, cell_;
  std::vector<Vector3d> vertices_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

void weld(std::vector<Vector3d>& vertices, std::vector<std::array<int, 3>>& triangles,
          double tolerance) {
  Vector3d origin = vertices.front();
  for (const Vector3d& x : vertices) origin = origin.cwiseMin(x);
  WeldGrid grid(origin, tolerance);
  std::vector<int> new_index;
  new_index.reserve(vertices.size());
  for (const Vector3d& x : vertices) new_index.push_back(grid.find_or_add(x));
  vertices = grid.take();
  for (auto& triangle : triangles)
    for (int& v : triangle) v = new_index[v];
}

// Twice the area over the longest side.
double thinnest_height(const std::array<int, 3>& t, const std::vector<Vector3d>& x) {
  const Vector3d a = x[t[1]] - x[t[0]], b = x[t[2]] - x[t[0]];
  const double longest = std::max({a.norm(), b.norm(), (a - b).norm()});
  return longest > 0 ? a.cross(b).norm() / longest : 0;
}

void drop_degenerate_and_duplicate(std::vector<std::array<int, 3>>& triangles,
                                   const std::vector<Vector3d>& x, double tolerance) {
  std::set<std::array<int, 3>> seen;
  std::erase_if(triangles, [&](const std::array<int, 3>& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || thinnest_height(t, x) <= tolerance)
      return true;
    std::array<int, 3> corners = t;
    std::sort(corners.begin(), corners.end());
    return !seen.insert(corners).second;
  });
}

void complete(Mesh& mesh) {
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
  if (triangles.empty()) throw InputError(name, "triangles", "none", "at least one");
  drop_unused_vertices(vertices_m, triangles);
  const double tolerance = weld_share * largest_distance(vertices_m);
  if (tolerance > 0) {
    weld(vertices_m, triangles, tolerance);
    drop_degenerate_and_duplicate(triangles, vertices_m, tolerance);
  }
  if (triangles.empty() || !(tolerance > 0))
    throw InputError(name, "triangles", "only triangles without area", "at least one with an area");
  drop_unused_vertices(vertices_m, triangles);
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.vertices_m = std::move(vertices_m);
  mesh.triangles = std::move(triangles);
  complete(mesh);
  return mesh;
}

}  // namespace edgescout
