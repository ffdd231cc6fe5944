// Finds the first part that a ray meets in a scene.
#pragma once

#include <vector>

#include "host/render/ray_tree.h"
#include "host/render/scene.h"

namespace edgescout {

struct SceneHit {
  int placed = -1;  // index into SimulatedScene::placed; -1: no part
  RayHit hit;       // on that part's mesh
};

// One tree for each mesh, in its own frame, serves all its instances.
class SceneRays {
 public:
  explicit SceneRays(const SimulatedScene& scene);  // `scene` must outlive this
  // The nearest part before `most_m`. World frame; `direction`: unit.
  SceneHit first_hit(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                     double most_m) const;

 private:
  struct Instance {
    int object = 0;
    Se3 object_from_world;
    Eigen::Vector3d middle_m;  // world frame
    double radius_m = 0;       // of a ball about the middle that holds the mesh
  };
  std::vector<RayTree> trees_;  // one for each object
  std::vector<Instance> instances_;
};

}  // namespace edgescout
