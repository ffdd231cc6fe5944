// Decides whether two poses lie within a tolerance, by their centres and orientations.
//
// Symmetries play no part (detect/distinct_poses.h): starts of one part stay on their side.
#pragma once

#include "host/register/scene.h"
#include "host/register/thresholds.h"

namespace edgescout {

// Whether two poses of the scene's objects are of one object and differ by less than this.
inline bool is_same_pose(const ObjectPose& a, const ObjectPose& b, const Scene& scene,
                         const thresholds::PoseTolerance& tolerance) {
  if (a.object != b.object) return false;
  const EdgeModel& model = scene.models[std::size_t(a.object)];
  return (a.world_from_object * model.center_m - b.world_from_object * model.center_m).norm() <
             tolerance.of_diameter * model.mesh.diameter_m &&
         angle_between_rad(a.world_from_object, b.world_from_object) < tolerance.angle_rad;
}

}  // namespace edgescout
