#include "host/render/simulated_cell.h"

#include <utility>

#include "host/core/options.h"
#include "host/core/random.h"
#include "host/render/renderer.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// The pose that the arm reaches: it moves the camera by a random error in the camera's own frame.
Se3 reached_pose(const Se3& camera_from_world, const ArmNoise& noise, Random random) {
  const auto error = [&](double sigma) {
    return Eigen::Vector3d{sigma * random.normal(), sigma * random.normal(),
                           sigma * random.normal()};
  };
  const Eigen::Vector3d shift_m = error(noise.translation_m), turn_rad = error(noise.rotation_rad);
  return Se3{so3_exp(turn_rad), shift_m} * camera_from_world;
}

}  // namespace

void ArmNoise::validate() const {
  const BoundsCheck in("arm_noise");
  in.require("translation_m", translation_m, 0, 1);
  in.require("rotation_rad", rotation_rad, 0, 1);
}

SimulatedCell::SimulatedCell(SimulatedScene scene, const Camera& camera,
                             std::vector<Se3> camera_from_world, const ArmNoise& noise,
                             ThreadPool& pool)
    : scene_(std::move(scene)),
      camera_(camera),
      camera_from_world_(std::move(camera_from_world)),
      noise_(noise),
      pool_(pool) {
  noise_.validate();
  check(!camera_.has_distortion(), "SimulatedCell: rendered images have no distortion");
}

Shot SimulatedCell::acquire(int view) {
  check(view >= 0 && view < static_cast<int>(camera_from_world_.size()),
        "ViewSource::acquire: no such view");
  const Se3& planned = camera_from_world_[static_cast<std::size_t>(view)];
  const Se3 reached =
      reached_pose(planned, noise_, Random(noise_.seed).split(static_cast<std::uint64_t>(view)));
  SimulatedScene scene = scene_;
  scene.views = {{camera_, reached}};
  scene.options.seed += static_cast<unsigned>(view);  // each image has its own sensor noise
  Rendering seen = std::move(render(scene, pool_)[0]);
  Shot shot{std::move(seen.image), noise_.known ? reached : planned};
  if (const DepthSensor& sensor = scene.options.depth; sensor.on)
    shot.depth = std::make_shared<const MeasuredDepth>(
        MeasuredDepth{std::move(seen.measured_depth), {sensor.noise_floor_m, sensor.noise_m}});
  return shot;
}

}  // namespace edgescout
