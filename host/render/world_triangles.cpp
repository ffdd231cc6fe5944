#include "host/render/world_triangles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace edgescout {

WorldTriangles::WorldTriangles(const SimulatedScene& scene) : scene_(scene) {
  for (const Object& object : scene.objects) normals_.push_back(smooth_normals(object.mesh));
  for (std::size_t p = 0; p < scene.placed.size(); ++p) {
    const PlacedObject& part = scene.placed[p];
    first.push_back(static_cast<int>(corners.size()));
    add(scene.objects[part.object].mesh, part.world_from_object);
    placed.resize(corners.size(), static_cast<int>(p));
  }
}

Eigen::Vector3d WorldTriangles::normal_at(int triangle, const Eigen::Vector3d& point_m) const {
  const auto& [first_corner, second_corner, third_corner] = corners[triangle];
  const Eigen::Vector3d& origin = vertices_m[first_corner];
  const Eigen::Vector3d a = vertices_m[second_corner] - origin,
                        b = vertices_m[third_corner] - origin, p = point_m - origin;
  const Eigen::Vector3d n = a.cross(b);
  const double area = n.squaredNorm();
  const double v = std::clamp(n.dot(p.cross(b)) / area, 0.0, 1.0),
               w = std::clamp(n.dot(a.cross(p)) / area, 0.0, 1.0 - v);
  const PlacedObject& part = scene_.placed[placed[triangle]];
  const CornerNormals& at = normals_[part.object][triangle - first[placed[triangle]]];
  const Eigen::Quaterniond& turn = part.world_from_object.rotation;
  return ((1 - v - w) * (turn * at[0]) + v * (turn * at[1]) + w * (turn * at[2])).normalized();
}

// Computes the corner normals of one mesh in its own frame: the mean, weighted by corner angle, of
// the faces that meet at the corner without a crease.
std::vector<WorldTriangles::CornerNormals> WorldTriangles::smooth_normals(const Mesh& mesh) {
  const double crease_cosine = std::cos(35 * std::numbers::pi / 180);
  std::vector<std::vector<std::pair<int, double>>> faces(mesh.vertices_m.size());  // face, angle
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto& corners = mesh.triangles[t];
      const Eigen::Vector3d at = mesh.vertices_m[corners[i]];
      const Eigen::Vector3d a = mesh.vertices_m[corners[(i + 1) % 3]] - at,
                            b = mesh.vertices_m[corners[(i + 2) % 3]] - at;
      faces[corners[i]].emplace_back(static_cast<int>(t), std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  std::vector<CornerNormals> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const auto& [face, angle] : faces[mesh.triangles[t][i]])
        if (mesh.face_normals[face].dot(mesh.face_normals[t]) > crease_cosine)
          sum += angle * mesh.face_normals[face];
      normals[t][i] = sum.normalized();
    }
  return normals;
}

}  // namespace edgescout
