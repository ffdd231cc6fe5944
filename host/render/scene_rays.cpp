#include "host/render/scene_rays.h"

namespace edgescout {
namespace {

bool meets_ball(const Eigen::Vector3d& to_middle, const Eigen::Vector3d& direction, double radius_m,
                double most_m) {
  const double along = to_middle.dot(direction), distance2 = to_middle.squaredNorm();
  if (distance2 <= radius_m * radius_m) return true;
  return along > 0 && along - radius_m < most_m && distance2 - along * along <= radius_m * radius_m;
}

}  // namespace

SceneRays::SceneRays(const SimulatedScene& scene) {
  for (const Object& object : scene.objects) trees_.emplace_back(object.mesh);
  for (const PlacedObject& part : scene.placed) {
    const Mesh& mesh = scene.objects[part.object].mesh;
    instances_.push_back({part.object, inverse(part.world_from_object),
                          part.world_from_object * (0.5 * (mesh.box_min_m + mesh.box_max_m)),
                          0.5 * (mesh.box_max_m - mesh.box_min_m).norm()});
  }
}

SceneHit SceneRays::first_hit(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                              double most_m) const {
  SceneHit nearest;
  nearest.hit.distance_m = most_m;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const Instance& instance = instances_[i];
    if (!meets_ball(instance.middle_m - origin_m, direction, instance.radius_m,
                    nearest.hit.distance_m))
      continue;
    RayHit hit;
    hit.distance_m = nearest.hit.distance_m;
    trees_[instance.object].intersect(instance.object_from_world * origin_m,
                                      instance.object_from_world.rotation * direction, hit);
    if (hit.triangle >= 0) nearest = {static_cast<int>(i), hit};
  }
  return nearest;
}

}  // namespace edgescout
