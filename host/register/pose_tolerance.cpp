#include "host/register/pose_tolerance.h"

namespace edgescout {

bool is_same_pose(const ObjectPose& a, const ObjectPose& b, const Scene& scene,
                  const thresholds::PoseTolerance& tolerance) {
  if (a.object != b.object) return false;
  const EdgeModel& model = scene.models[std::size_t(a.object)];
  return (a.world_from_object * model.center_m - b.world_from_object * model.center_m).norm() <
             tolerance.of_diameter * model.mesh.diameter_m &&
         angle_between_rad(a.world_from_object, b.world_from_object) < tolerance.angle_rad;
}

}  // namespace edgescout
