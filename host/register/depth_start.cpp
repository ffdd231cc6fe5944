#include "host/register/depth_start.h"

#include <cmath>
#include <vector>

#include "host/core/quantile.h"
#include "host/register/measured_depth.h"
#include "host/register/occluders.h"

namespace edgescout {

namespace {

// Measured minus expected z of the samples that face the camera.
std::vector<double> offsets_m(const EdgeModel& model, const Se3& camera_from_object,
                              const ObjectView& view) {
  std::vector<double> offsets;
  const DepthImage& depth = view.depth->image;
  for (const SurfacePoint& sample : model.surface_points) {
    const Eigen::Vector3d point_m =
                              camera_from_object * Eigen::Vector3d(sample.x_m, sample.y_m, sample.z_m),
                          normal = camera_from_object.rotation *
                                   Eigen::Vector3d(sample.nx, sample.ny, sample.nz);
    if (!(point_m.z() > 0) || normal.dot(point_m) >= 0) continue;
    const Eigen::Vector2d pixel = project(view.camera, point_m).array().round();
    if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < depth.width && pixel.y() < depth.height))
      continue;
    const float z_m = depth.at(int(pixel.x()), int(pixel.y()));
    if (z_m > 0) offsets.push_back(double(z_m) - point_m.z());
  }
  return offsets;
}

}  // namespace

ObjectPose moved_onto_depth(const Scene& scene, const ObjectPose& start) {
  constexpr std::size_t least = 20;
  const EdgeModel& model = scene.models[std::size_t(start.object)];
  for (const ObjectView& view : scene.views) {
    if (!view.depth) continue;
    Se3 camera_from_object = view.camera_from_world * start.world_from_object;
    std::vector<double> offsets = offsets_m(model, camera_from_object, view);
    if (offsets.size() < least) continue;
    const double median_m = quantile(std::move(offsets), 0.5);
    const Eigen::Vector3d center_m = camera_from_object * model.center_m;
    if (std::abs(median_m) < occlusion_tolerance_m(model) || !(center_m.z() + median_m > 0))
      return start;
    camera_from_object.translation_m += center_m * (median_m / center_m.z());
    return {start.object, inverse(view.camera_from_world) * camera_from_object};
  }
  return start;
}

}  // namespace edgescout
