#include "host/render/reflection.h"

#include <cmath>

namespace edgescout {

Reflections::Reflections(const SimulatedScene& scene, const WorldTriangles& triangles,
                         const Lighting& lighting)
    : scene_(scene), triangles_(triangles), lighting_(lighting), rays_(scene), plane_(scene) {}

double Reflections::at(const ShadedPoint& surface, const Material& material,
                       const LobeSample& lobe) const {
  constexpr double OFF_SURFACE_M = 2e-5;  // so that a ray does not meet where it starts
  const FacetSample sample = Microfacets(surface, material).sample(lobe.u, lobe.v);
  if (sample.weight <= 0) return 0;
  const Environment& environment =
      material.mirrors_lamps() ? *scene_.environment_with_lamps : *scene_.environment;
  // The solid angle that the sample stands for. Four times as much is read, against noise (Krivanek
  // and Colbert, "Real-time Shading with Filtered Importance Sampling", 2008).
  const double solid_angle = 4 / (lobe.count * sample.density);
  const Ray ray{surface.point_m + OFF_SURFACE_M * surface.normal, sample.direction, lobe.eighth};
  return sample.weight * arriving(ray, environment, solid_angle);
}

double Reflections::arriving(const Ray& ray, const Environment& environment,
                             double solid_angle) const {
  const double to_plane_m = ray.direction.z() < 0 && ray.origin_m.z() > 0
                                ? -ray.origin_m.z() / ray.direction.z()
                                : std::numeric_limits<double>::infinity();
  const SceneHit hit = rays_.first_hit(ray.origin_m, ray.direction, to_plane_m);
  if (hit.placed >= 0) return light_of_part(hit, ray);
  if (std::isfinite(to_plane_m))
    return light_of_plane(ray.origin_m + to_plane_m * ray.direction, ray.eighth);
  return environment.light(ray.direction, solid_angle);
}

double Reflections::light_of_part(const SceneHit& hit, const Ray& ray) const {
  const Eigen::Vector3d point_m = ray.origin_m + hit.hit.distance_m * ray.direction;
  Eigen::Vector3d normal =
      triangles_.normal_at(triangles_.first[hit.placed] + hit.hit.triangle, point_m);
  if (normal.dot(ray.direction) > 0) normal = -normal;
  const Material& material = scene_.placed[hit.placed].material;
  const double matt = material.albedo > 0 ? material.albedo * lighting_.diffuse_by_eighth(
                                                                  point_m, normal, ray.eighth)
                                          : 0.0;
  if (material.reflectance == 0) return matt;
  const Eigen::Vector3d onward = ray.direction - 2 * ray.direction.dot(normal) * normal;
  constexpr double WIDE = 0.3;  // steradians
  const double mirrored = onward.z() > 0 ? scene_.environment->light(onward, WIDE)
                                         : scene_.desk_albedo * scene_.environment->irradiance();
  return matt + material.reflectance * mirrored;
}

double Reflections::light_of_plane(const Eigen::Vector3d& point_m, int eighth) const {
  return plane_.albedo(point_m) *
         lighting_.diffuse_by_eighth(point_m, Eigen::Vector3d::UnitZ(), eighth);
}

}  // namespace edgescout
