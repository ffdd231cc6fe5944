#include "host/model/occluding_surface.h"

#include "host/model/simplify.h"

namespace edgescout {

OccludingSurface occluding_surface(const Mesh& mesh) {
  const bool is_dense = mesh.triangles.size() > OCCLUDING_SURFACE_FULL;
  const std::vector<std::array<int, 3>> triangles =
      is_dense ? simplify(mesh, OCCLUDING_SURFACE_ERROR * mesh.diameter_m) : mesh.triangles;
  std::vector<int> new_index(mesh.vertices_m.size(), -1);
  for (const auto& triangle : triangles)
    for (const int v : triangle) new_index[v] = 0;
  OccludingSurface surface;
  int used = 0;
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] < 0) continue;
    new_index[v] = used++;
    for (int i = 0; i < 3; ++i) surface.vertices_m.push_back(float(mesh.vertices_m[v][i]));
  }
  for (const auto& triangle : triangles)
    for (const int v : triangle)
      surface.triangles.push_back(static_cast<std::uint32_t>(new_index[v]));
  return surface;
}

}  // namespace edgescout
