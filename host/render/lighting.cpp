#include "host/render/lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace edgescout {
namespace {

// Computes the corner normals of one mesh in its own frame: the mean, weighted by corner angle, of
// the faces that meet at the corner without a crease.
std::vector<TriangleCorners> smooth_normals(const Mesh& mesh) {
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
  std::vector<TriangleCorners> normals(mesh.triangles.size());
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

double scene_reach_m(const WorldTriangles& triangles) {
  double reach = 0;
  for (const TriangleCorners& t : triangles.corners_m)
    for (const Eigen::Vector3d& x : t) reach = std::max(reach, x.norm());
  return reach;
}

// A camera at the light that looks at the origin and sees a ball of `reach_m` about it.
SceneView light_view(const Eigen::Vector3d& position_m, double reach_m, int size_px) {
  SceneView view;
  view.camera.width = view.camera.height = size_px;
  view.camera.fx = view.camera.fy =
      0.5 * size_px * std::sqrt(position_m.squaredNorm() - reach_m * reach_m) / reach_m;
  view.camera.cx = view.camera.cy = 0.5 * (size_px - 1);
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond::FromTwoVectors(-position_m, Eigen::Vector3d::UnitZ());
  view.camera_from_world = {rotation, -(rotation * position_m)};
  return view;
}

Eigen::Matrix<double, 3, 4> pixel_from_world(const SceneView& view) {
  Eigen::Matrix3d calibration;
  calibration << view.camera.fx, 0, view.camera.cx, 0, view.camera.fy, view.camera.cy, 0, 0, 1;
  Eigen::Matrix<double, 3, 4> pose;
  pose << view.camera_from_world.rotation.toRotationMatrix(), view.camera_from_world.translation_m;
  return calibration * pose;
}

}  // namespace

WorldTriangles world_triangles(const SimulatedScene& scene) {
  std::vector<std::vector<TriangleCorners>> normals;
  for (const Object& object : scene.objects) normals.push_back(smooth_normals(object.mesh));
  WorldTriangles world;
  for (std::size_t p = 0; p < scene.placed.size(); ++p) {
    const PlacedObject& part = scene.placed[p];
    const Mesh& mesh = scene.objects[part.object].mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      TriangleCorners corners, turned;
      for (int i = 0; i < 3; ++i) {
        corners[i] = part.world_from_object * mesh.vertices_m[mesh.triangles[t][i]];
        turned[i] = part.world_from_object.rotation * normals[part.object][t][i];
      }
      world.corners_m.push_back(corners);
      world.normals.push_back(turned);
      world.placed.push_back(static_cast<int>(p));
    }
  }
  return world;
}

Lighting::Lighting(const SimulatedScene& scene, const WorldTriangles& triangles, ThreadPool& pool)
    : scene_(scene) {
  if (!scene.options.shadows) return;
  const double reach = 1.02 * scene_reach_m(triangles);
  for (const Light& light : scene.lights) {
    const SceneView view = light_view(
        light.position_m, std::min(reach, 0.9 * light.position_m.norm()), light.shadow_px);
    Raster raster = rasterize(triangles.corners_m, view.camera, view.camera_from_world, pool);
    maps_.push_back({light.shadow_px, pixel_from_world(view), std::move(raster.depth_m),
                     light.position_m.norm() / view.camera.fx});
  }
}

double Lighting::lit_fraction(const ShadowMap& map, const Eigen::Vector3d& point_m,
                              const Eigen::Vector3d& normal) const {
  // The point is moved off the surface by one texel, else the surface would shade itself.
  const Eigen::Vector3d x =
      map.pixel_from_world * (point_m + 1.5 * map.texel_m * normal).homogeneous();
  const Eigen::Vector2d pixel = x.hnormalized();
  const double u = std::floor(pixel.x()), v = std::floor(pixel.y());
  if (!(u >= 1 && v >= 1 && u < map.size_px - 2 && v < map.size_px - 2)) return 1;
  const double fu = pixel.x() - u, fv = pixel.y() - v;
  const float depth = static_cast<float>(x.z() - map.texel_m);
  // Mean over a box two texels wide about the point: percentage-closer filtering with bilinear
  // weights.
  const double weight_x[4] = {0.5 * (1 - fu), 0.5, 0.5, 0.5 * fu},
               weight_y[4] = {0.5 * (1 - fv), 0.5, 0.5, 0.5 * fv};
  double lit = 0;
  for (int j = 0; j < 4; ++j) {
    const float* row = &map.depth_m[(static_cast<std::size_t>(v) - 1 + j) * map.size_px +
                                    static_cast<std::size_t>(u) - 1];
    for (int i = 0; i < 4; ++i)
      if (row[i] >= depth) lit += weight_x[i] * weight_y[j];
  }
  return lit / 2.25;
}

ReceivedLight Lighting::at(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal,
                           const Eigen::Vector3d& to_viewer, const Material& material) const {
  ReceivedLight received;
  received.diffuse = scene_.ambient;
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const Light& light = scene_.lights[i];
    const Eigen::Vector3d to_light = light.position_m - point_m;
    const double distance = to_light.norm(), cosine = normal.dot(to_light) / distance;
    if (cosine <= 0) continue;
    double irradiance =
        light.irradiance * cosine * light.position_m.squaredNorm() / (distance * distance);
    if (!maps_.empty()) irradiance *= lit_fraction(maps_[i], point_m, normal);
    if (irradiance <= 0) continue;
    received.diffuse += irradiance;
    const double half = std::max(0.0, normal.dot((to_light / distance + to_viewer).normalized()));
    received.specular += material.specular * irradiance * (material.shininess + 8) / 8 *
                         std::pow(half, material.shininess);
  }
  return received;
}

}  // namespace edgescout
