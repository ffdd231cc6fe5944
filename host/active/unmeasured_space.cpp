#include "host/active/unmeasured_space.h"

#include <algorithm>
#include <cmath>

#include "host/active/seen_points.h"
#include "host/active/views.h"
#include "host/core/camera.h"
#include "host/register/measured_depth.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr double CELLS = 32768;
constexpr double MOST_ALONG_A_SIDE = 128;  // of flat and thin boxes

// Whether the image measured the place itself or something behind it.
bool is_measured(const ObjectView& view, const Eigen::Vector3d& middle_m, double cell_m) {
  const Eigen::Vector3d in_camera = view.camera_from_world * middle_m;
  if (in_camera.z() <= 0) return false;
  const Eigen::Vector2d pixel = project(view.camera, in_camera).array().round();
  const DepthImage& depth = view.depth->image;
  if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < depth.width && pixel.y() < depth.height))
    return false;
  const float z_m = depth.at(int(pixel.x()), int(pixel.y()));
  return z_m > 0 && in_camera.z() < double(z_m) + 0.5 * cell_m;
}

bool is_seen(const Eigen::Vector3d& in_camera, const Occluders& surfaces, double tolerance_m) {
  if (in_camera.z() <= 0) return false;
  const Eigen::Vector2d pixel = project(surfaces.camera, in_camera);
  return is_in_image(pixel.x(), pixel.y(), surfaces.camera) &&
         !surfaces.hide(in_camera, tolerance_m);
}

}  // namespace

std::optional<Workspace> workspace_of(const WorldPrior& prior,
                                      std::span<const Se3> camera_from_world,
                                      const Camera& camera) {
  if (!prior.box_m.empty()) return Workspace{prior.box(), inverse(prior.prior_from_world), {}};
  const std::optional<Eigen::Vector3d> middle_m = looked_at_m(camera_from_world);
  if (!middle_m) return {};
  const double half_angle_rad =
      std::atan(0.5 * std::min(camera.width / camera.fx, camera.height / camera.fy));
  double radius_m = INFINITY;
  for (const Se3& view : camera_from_world)
    radius_m = std::min(radius_m, (view * *middle_m).norm() * std::sin(half_angle_rad));
  const Eigen::Vector3d half_m = Eigen::Vector3d::Constant(radius_m);
  return Workspace{{*middle_m - half_m, *middle_m + half_m}, {}, radius_m};
}

UnmeasuredSpace unmeasured_space(std::span<const ObjectView> views, const Workspace& workspace,
                                 ThreadPool& pool) {
  UnmeasuredSpace space;
  const Eigen::Vector3d size_m = workspace.box_m.sizes();
  space.cell_m = std::max(std::cbrt(size_m.prod() / CELLS), size_m.maxCoeff() / MOST_ALONG_A_SIDE);
  const Eigen::Array3i cells = (size_m.array() / space.cell_m).ceil().cast<int>().max(1);
  const auto keep_unmeasured = [&](int x, int y, int z, std::vector<Eigen::Vector3d>& kept) {
    const Eigen::Vector3d in_box =
        workspace.box_m.min() + space.cell_m * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
    if (workspace.radius_m && (in_box - workspace.box_m.center()).norm() > *workspace.radius_m)
      return;
    const Eigen::Vector3d middle_m = workspace.world_from_box * in_box;
    if (std::ranges::none_of(views, [&](const ObjectView& view) {
          return view.depth && is_measured(view, middle_m, space.cell_m);
        }))
      kept.push_back(middle_m);
  };
  std::vector<std::vector<Eigen::Vector3d>> of_layer(std::size_t(cells.z()));
  pool.for_each(of_layer.size(), [&](std::size_t z) {
    for (int y = 0; y < cells.y(); ++y)
      for (int x = 0; x < cells.x(); ++x) keep_unmeasured(x, y, int(z), of_layer[z]);
  });
  for (const std::vector<Eigen::Vector3d>& layer : of_layer)
    space.middle_m.insert(space.middle_m.end(), layer.begin(), layer.end());
  return space;
}

double volume_seen_m3(const UnmeasuredSpace& space, const Occluders& surfaces,
                      const Se3& camera_from_world) {
  std::size_t seen = 0;
  for (const Eigen::Vector3d& middle_m : space.middle_m)
    seen += is_seen(camera_from_world * middle_m, surfaces, space.cell_m);
  return double(seen) * std::pow(space.cell_m, 3);
}

}  // namespace edgescout
