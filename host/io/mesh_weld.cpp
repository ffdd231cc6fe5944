// Makes near vertices one; drops triangles without area and duplicates.
#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "host/io/mesh_repair.h"
#include "host/io/point_grid.h"

namespace edgescout {

using Eigen::Vector3d;

double smallest_height(const RawMesh& mesh, const std::array<int, 3>& triangle) {
  const Vector3d& origin = mesh.vertices[triangle[0]];
  const Vector3d a = mesh.vertices[triangle[1]] - origin, b = mesh.vertices[triangle[2]] - origin;
  const double longest = std::max({a.norm(), b.norm(), (a - b).norm()});
  return longest > 0 ? a.cross(b).norm() / longest : 0;
}

void drop_unused_vertices(RawMesh& mesh) {
  std::vector<int> new_index(mesh.vertices.size(), -1);
  std::vector<Vector3d> used;
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) {
      if (new_index[v] < 0) {
        new_index[v] = static_cast<int>(used.size());
        used.push_back(mesh.vertices[v]);
      }
      v = new_index[v];
    }
  mesh.vertices = std::move(used);
}

void weld_vertices(RawMesh& mesh, double tolerance_m) {
  Vector3d origin = mesh.vertices.front();
  for (const Vector3d& x : mesh.vertices) origin = origin.cwiseMin(x);
  PointGrid grid(origin, 16 * tolerance_m);
  std::vector<Vector3d> kept;
  std::vector<int> new_index;
  new_index.reserve(mesh.vertices.size());
  for (const Vector3d& x : mesh.vertices) {
    int same = -1;
    grid.for_each_near(x, tolerance_m, [&](int v) { same = same < 0 ? v : same; });
    if (same < 0) {
      same = static_cast<int>(kept.size());
      kept.push_back(x);
      grid.add(x, same);
    }
    new_index.push_back(same);
  }
  mesh.vertices = std::move(kept);
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = new_index[v];
}

void drop_slivers_and_duplicates(RawMesh& mesh, double tolerance_m) {
  std::set<std::array<int, 3>> seen;
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || smallest_height(mesh, t) <= tolerance_m)
      return true;
    std::array<int, 3> corners = t;
    std::ranges::sort(corners);
    return !seen.insert(corners).second;
  });
}

}  // namespace edgescout
