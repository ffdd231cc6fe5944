#include "host/render/scene_geometry.h"

#include <algorithm>
#include <cmath>

namespace edgescout {

Eigen::Vector3d middle_m(const Mesh& mesh) {
  const Eigen::Vector3d box_m = (mesh.box_min_m + mesh.box_max_m) / 2;
  return box_m.norm() < 1e-6 * mesh.diameter_m ? Eigen::Vector3d::Zero() : box_m;
}

double reach_m(const SimulatedScene& scene) {
  double reach = 0;
  for (const PlacedObject& part : scene.placed) {
    const Mesh& mesh = scene.objects[part.object].mesh;
    if (part.target)
      reach = std::max(reach, (part.world_from_object * middle_m(mesh)).head<2>().norm() +
                                  0.5 * mesh.diameter_m);
  }
  return reach;
}

const PlacedObject& random_target(const SimulatedScene& scene, Random& random) {
  const PlacedObject* target = nullptr;
  while (!target || !target->target)
    target = &scene.placed[random.below(static_cast<int>(scene.placed.size()))];
  return *target;
}

double mean_diameter_m(std::span<const Object> objects) {
  double sum = 0;
  for (const Object& object : objects) sum += object.mesh.diameter_m;
  return sum / static_cast<double>(objects.size());
}

Eigen::Vector3d on_sphere(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

}  // namespace edgescout
