#include "host/register/move_onto_depth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "host/register/measured_depth.h"
#include "host/register/occluders.h"
#include "host/register/thresholds.h"

namespace edgescout {

namespace {

// Measured minus expected z of the samples that face the camera.
std::vector<double> offsets_m(const EdgeModel& model, const Se3& camera_from_object,
                              const ObjectView& view) {
  std::vector<double> offsets;
  const DepthImage& depth = view.depth->image;
  for (const SurfacePoint& sample : model.surface_points) {
    const Eigen::Vector3d point_m = camera_from_object *
                                    Eigen::Vector3d(sample.x_m, sample.y_m, sample.z_m),
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

// The middle of the interval of this width that holds most of the values, which are not empty.
double densest(std::vector<double> values, double width) {
  std::ranges::sort(values);
  std::size_t most = 0;
  double middle = values[0];
  for (std::size_t first = 0, last = 0; first < values.size(); ++first) {
    while (last < values.size() && values[last] <= values[first] + width) ++last;
    if (last - first <= most) continue;
    most = last - first;
    middle = values[first + most / 2];
  }
  return middle;
}

// Of one view. Nothing: too little is measured, or the start lies on the surface.
std::optional<Se3> moved_once(const EdgeModel& model, const Se3& camera_from_object,
                              const ObjectView& view) {
  const std::vector<double> offsets = offsets_m(model, camera_from_object, view);
  const double tolerance_m = occlusion_tolerance_m(model);
  if (offsets.size() < thresholds::MIN_DEPTH_SAMPLES) return {};
  const double offset_m = densest(offsets, tolerance_m);
  const Eigen::Vector3d center_m = camera_from_object * model.center_m;
  if (std::abs(offset_m) < tolerance_m || !(center_m.z() + offset_m > 0)) return {};
  return Se3{camera_from_object.rotation,
             camera_from_object.translation_m + center_m * (offset_m / center_m.z())};
}

}  // namespace

ObjectPose moved_onto_depth(const Scene& scene, const ObjectPose& start) {
  constexpr int most_moves = 3;  // nearer, the start covers other pixels
  const EdgeModel& model = scene.models[std::size_t(start.object)];
  const auto view = std::ranges::find_if(
      scene.views, [](const ObjectView& candidate) { return candidate.depth != nullptr; });
  if (view == scene.views.end()) return start;
  ObjectPose moved = start;
  for (int i = 0; i < most_moves; ++i) {
    const std::optional<Se3> next =
        moved_once(model, view->camera_from_world * moved.world_from_object, *view);
    if (!next) break;
    moved.world_from_object = inverse(view->camera_from_world) * *next;
  }
  return moved;
}

}  // namespace edgescout
