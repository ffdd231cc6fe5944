// A part before a wall, as a depth sensor measures both.
#pragma once

#include "host/register/measured_depth.h"
#include "host/register/occluders.h"
#include "tests/register/scene.h"

namespace edgescout::test {

// z of the part, or of the wall where the part is not seen; with Gaussian noise.
inline DepthImage measured_part(const PartScene& scene, std::size_t view, double wall_m,
                                const DepthNoise& noise, Random& random, Backend& backend) {
  const ObjectView& seen = scene.views[view];
  const Camera& camera = seen.camera;
  DepthImage depth{camera.width, camera.height, {}};
  depth.z_m.resize(std::size_t(camera.width) * std::size_t(camera.height));
  const DepthJob job{to_pose(seen.camera_from_world * scene.truth), intrinsics_of(camera)};
  backend.depth_raster(scene.model.triangle_mesh(), {&job, 1}, camera.width, camera.height,
                       depth.z_m);
  for (float& z_m : depth.z_m) {
    if (z_m == DEPTH_EMPTY) z_m = float(wall_m);
    z_m += float(noise.sigma_m(z_m) * random.normal());
  }
  return depth;
}

inline void set_depth(ObjectView& view, DepthImage depth, const DepthNoise& noise,
                      Backend& backend) {
  view.depth_values =
      backend.make_depth({depth.z_m, depth.width, depth.height, intrinsics_of(view.camera)});
  view.depth = std::make_shared<const MeasuredDepth>(MeasuredDepth{std::move(depth), noise});
  view.occluders = make_occluders({}, {}, view, backend);
}

// A scene of one view whose depth is measured.
struct DepthScene : PartScene {
  static constexpr double wall_m = 0.6;
  DepthNoise noise{5e-4, 1e-3};

  DepthScene(const std::string& part, Random& random, Backend& backend)
      : PartScene(part, 1, random, backend) {
    set_depth(views[0], measured_part(*this, 0, wall_m, noise, random, backend), noise, backend);
  }
  // The truth, moved along the camera's axis.
  ObjectPose moved_m(double along_axis_m) const {
    Se3 camera_from_object = views[0].camera_from_world * truth;
    camera_from_object.translation_m.z() += along_axis_m;
    return {0, inverse(views[0].camera_from_world) * camera_from_object};
  }
  double axis_error_m(const Se3& world_from_object) const {
    const auto z_m = [&](const Se3& pose) {
      return (views[0].camera_from_world * (pose * model.center_m)).z();
    };
    return std::abs(z_m(world_from_object) - z_m(truth));
  }
  void forget_depth() {
    views[0].depth.reset();
    views[0].depth_values.reset();
    views[0].occluders.reset();
  }
};

}  // namespace edgescout::test
