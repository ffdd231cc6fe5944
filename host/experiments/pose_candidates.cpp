#include "host/experiments/pose_candidates.h"

#include <algorithm>

#include "host/core/random.h"

namespace edgescout {

namespace {

Se3 camera_from_instance(const KnownScene& scene, const KnownInstance& instance) {
  return scene.images[0].camera_from_world * instance.world_from_object;
}

// In the camera frame.
struct Cube {
  Eigen::Vector3d middle_m;
  double half_side_m = 0;
};

Cube cube_around(const KnownScene& scene) {
  Eigen::AlignedBox3d box;
  double margin_m = 0;
  for (const KnownInstance& instance : scene.instances) {
    box.extend(camera_from_instance(scene, instance).translation_m);
    margin_m = std::max(margin_m, scene.objects[instance.object].mesh.diameter_m);
  }
  return {box.center(), 0.5 * box.sizes().maxCoeff() + margin_m};
}

int instance_at(const KnownScene& scene, int object, const Se3& pose) {
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const KnownInstance& instance = scene.instances[i];
    if (instance.object == object &&
        pose_error(pose, camera_from_instance(scene, instance), scene.objects[object].symmetries)
            .passes(CANDIDATE_ANGLE_RAD, CANDIDATE_DISTANCE_M))
      return static_cast<int>(i);
  }
  return -1;
}

Se3 near_pose(const Se3& truth, Random& random) {
  const Eigen::Vector3d shift = random.direction();
  const double distance_m = CANDIDATE_DISTANCE_M * random.uniform();
  const Eigen::Vector3d axis = random.direction();
  const double angle_rad = CANDIDATE_ANGLE_RAD * random.uniform();
  Vector6d offset;
  offset << distance_m * shift, angle_rad * axis;
  return retract(truth, offset);
}

bool is_seen(const Se3& pose, const Camera& camera, double diameter_m) {
  if (pose.translation_m.z() < diameter_m) return false;
  const Eigen::Vector2d at = project(camera, pose.translation_m);
  return at.x() >= 0 && at.y() >= 0 && at.x() < camera.width && at.y() < camera.height;
}

Se3 far_pose(const Cube& cube, const Camera& camera, double diameter_m, Random& random) {
  for (;;) {
    Eigen::Vector3d offset;
    for (const int axis : {2, 1, 0}) offset[axis] = random.uniform(-1, 1);
    if (const Se3 pose{random.rotation(), cube.middle_m + cube.half_side_m * offset};
        is_seen(pose, camera, diameter_m))
      return pose;
  }
}

}  // namespace

std::vector<PoseCandidate> pose_candidates(const KnownScene& scene, int object, int count,
                                           unsigned seed) {
  Random random = Random(seed)
                      .split("candidates")
                      .split(scene.set)
                      .split(scene.name)
                      .split(static_cast<std::uint64_t>(object));
  std::vector<Se3> poses;
  for (const KnownInstance& instance : scene.instances)
    for (int i = 0; instance.object == object && i < CANDIDATES_AN_INSTANCE &&
                    static_cast<int>(poses.size()) < count;
         ++i)
      poses.push_back(near_pose(camera_from_instance(scene, instance), random));
  const Cube cube = cube_around(scene);
  while (static_cast<int>(poses.size()) < count)
    poses.push_back(
        far_pose(cube, scene.images[0].camera, scene.objects[object].mesh.diameter_m, random));
  std::vector<PoseCandidate> candidates;
  for (const Se3& pose : poses) candidates.push_back({pose, instance_at(scene, object, pose)});
  return candidates;
}

}  // namespace edgescout
