#include "host/render/lighting.h"

#include <algorithm>
#include <cmath>

namespace edgescout {
namespace {

// What hangs before the cameras may be far away; shadow maps are for what lies on the board.
double scene_reach_m(const SimulatedScene& scene, const WorldTriangles& triangles) {
  double reach = 0;
  for (std::size_t t = 0; t < triangles.corners.size(); ++t)
    if (!scene.placed[triangles.placed[t]].hangs)
      for (const int vertex : triangles.corners[t])
        reach = std::max(reach, triangles.vertices_m[vertex].norm());
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

// Light towards the viewer.
double blinn_phong(const ShadedPoint& surface, const Material& material,
                   const Eigen::Vector3d& to_light, double irradiance) {
  const double half =
      std::max(0.0, surface.normal.dot((to_light + surface.to_viewer).normalized()));
  return material.specular * irradiance * (material.shininess + 8) / 8 *
         std::pow(half, material.shininess);
}

}  // namespace

Lighting::Lighting(const SimulatedScene& scene, const WorldTriangles& triangles, ThreadPool& pool)
    : scene_(scene) {
  if (!scene.options.shadows) return;
  const double reach = 1.02 * scene_reach_m(scene, triangles);
  for (const Light& light : scene.lights) {
    const SceneView view = light_view(
        light.position_m, std::min(reach, 0.9 * light.position_m.norm()), light.shadow_px);
    Raster raster = rasterize(triangles, view.camera, view.camera_from_world, pool);
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

Lighting::Beam Lighting::beam_of(const Light& light, const Eigen::Vector3d& point_m,
                                 const Eigen::Vector3d& normal) {
  const Eigen::Vector3d to_light = light.position_m - point_m;
  const double distance = to_light.norm(), cosine = normal.dot(to_light) / distance;
  if (cosine <= 0) return {};
  return {to_light / distance,
          light.irradiance * cosine * light.position_m.squaredNorm() / (distance * distance)};
}

Lighting::Beam Lighting::shadowed_beam(std::size_t light, const Eigen::Vector3d& point_m,
                                       const Eigen::Vector3d& normal) const {
  Beam beam = beam_of(scene_.lights[light], point_m, normal);
  if (beam.irradiance > 0 && !maps_.empty())
    beam.irradiance *= lit_fraction(maps_[light], point_m, normal);
  return beam;
}

ReceivedLight Lighting::at(const ShadedPoint& surface, const Material& material) const {
  ReceivedLight received;
  received.diffuse = scene_.ambient;
  const Microfacets facets(surface, material);
  const bool has_highlights = material.reflectance > 0 && !material.mirrors_lamps();
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const Beam beam = shadowed_beam(i, surface.point_m, surface.normal);
    if (beam.irradiance <= 0) continue;
    received.diffuse += beam.irradiance;
    if (material.specular > 0)
      received.specular += blinn_phong(surface, material, beam.to_light, beam.irradiance);
    if (has_highlights && !scene_.lights[i].is_sky)
      received.specular += beam.irradiance * facets.highlight(beam.to_light);
  }
  return received;
}

double Lighting::diffuse(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal) const {
  double sum = scene_.ambient;
  for (std::size_t i = 0; i < scene_.lights.size(); ++i)
    sum += shadowed_beam(i, point_m, normal).irradiance;
  return sum;
}

double Lighting::diffuse_by_eighth(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal,
                                   int eighth) const {
  double sum = 0;
  for (std::size_t i = eighth; i < scene_.lights.size(); i += 8)
    sum += shadowed_beam(i, point_m, normal).irradiance;
  return scene_.ambient + 8 * sum;
}

double Lighting::lit_share(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal) const {
  double without_shadows = scene_.ambient;
  for (const Light& light : scene_.lights)
    without_shadows += beam_of(light, point_m, normal).irradiance;
  return without_shadows > 0 ? diffuse(point_m, normal) / without_shadows : 1;
}

}  // namespace edgescout
