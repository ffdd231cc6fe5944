// Random poses and the distance between two of them, for the tests of distinct_poses.h.
#pragma once

#include <algorithm>

#include "host/core/se3.h"
#include "host/core/types.h"
#include "tests/test_random.h"

namespace edgescout::test {

inline Se3 any_pose(Random& random) {
  return {random.rotation(), {random.uniform(), random.uniform(), random.uniform()}};
}

inline Se3 randomly_moved(const Se3& pose, double distance_m, double angle_rad, Random& random) {
  Vector6d delta;
  delta << distance_m * random.direction(), angle_rad * random.direction();
  return retract(pose, delta);
}

// The largest distance of a corner of the box at the best symmetry, by the definition.
inline double brute_distance(const Se3& a, const Se3& b, const Object& object) {
  double best = 1e9;
  for (const Se3& symmetry : object.symmetries.discrete) {
    double worst = 0;
    for (double x : {object.mesh.box_min_m.x(), object.mesh.box_max_m.x()})
      for (double y : {object.mesh.box_min_m.y(), object.mesh.box_max_m.y()})
        for (double z : {object.mesh.box_min_m.z(), object.mesh.box_max_m.z()})
          worst = std::max(
              worst,
              (a * Eigen::Vector3d(x, y, z) - b * (symmetry * Eigen::Vector3d(x, y, z))).norm());
    best = std::min(best, worst);
  }
  return best;
}

}  // namespace edgescout::test
