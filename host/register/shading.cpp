#include "host/register/shading.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "host/register/occluders.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// Image pixels between pixels of the map. Blur at a silhouette must not reach the next pixel
// inside.
constexpr int FEWEST_STRIDE = 2;
constexpr int HARMONICS = int(SHADING_HARMONICS);
constexpr double FEWEST_PIXELS = 60;  // nine harmonics explain any grey of fewer pixels
using Harmonics = Eigen::Matrix<double, HARMONICS, 1>;

// The map that just holds the object.
ShadingJob frame_object(const EdgeModel& model, const Se3& camera_from_object,
                        const Intrinsics& k) {
  constexpr int size = int(SHADING_MAP_PX);
  const Eigen::Vector3d center = camera_from_object * model.center_m;
  const double reach = std::max(center.z() - model.radius_m, 0.05 * center.z());
  const double half_px =
      std::max(k.fx, k.fy) * model.radius_m / reach * (1 + center.head<2>().norm() / center.z());
  const int stride = std::clamp(int(std::ceil(2 * half_px / (size - 4))), FEWEST_STRIDE, 1000);
  const double left = k.fx * center.x() / center.z() + k.cx - 0.5 * stride * size,
               top = k.fy * center.y() / center.z() + k.cy - 0.5 * stride * size;
  const auto whole = [](double v) { return int(std::clamp(std::round(v), -1e6, 1e6)); };
  return {to_pose(camera_from_object), whole(left), whole(top), std::uint32_t(stride), 0};
}

// Least squares of grey on the harmonics.
Shading explain(const ShadingSums& sums) {
  if (sums.pixels < FEWEST_PIXELS) return {};
  Eigen::Matrix<double, HARMONICS, HARMONICS> system;
  int entry = 0;
  for (int a = 0; a < HARMONICS; ++a)
    for (int b = a; b < HARMONICS; ++b) system(b, a) = sums.system[entry++];
  system.diagonal().array() += 1e-6 * sums.pixels;  // few faces leave harmonics undetermined
  const Eigen::Map<const Harmonics> right(sums.right);
  const Harmonics best = system.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  const double about_mean = sums.squares - sums.grey * sums.grey / sums.pixels;
  return {sums.pixels, about_mean, std::clamp(sums.squares - best.dot(right), 0.0, about_mean)};
}

// Maps of one object's poses in all views.
struct Tasks {
  struct Task {
    std::size_t pose, view;
  };
  std::vector<Task> list;
  std::vector<ShadingJob> jobs;
};

Tasks tasks_of(const Scene& scene, std::span<const ObjectPose> poses, std::size_t object) {
  const EdgeModel& model = scene.models[object];
  Tasks tasks;
  for (std::size_t p = 0; p < poses.size(); ++p)
    for (std::size_t v = 0; poses[p].object == int(object) && v < scene.views.size(); ++v) {
      const ObjectView& view = scene.views[v];
      const Se3 camera_from_object = view.camera_from_world * poses[p].world_from_object;
      if (!view.image || (camera_from_object * model.center_m).z() <= model.radius_m * 0.05)
        continue;
      tasks.list.push_back({p, v});
      tasks.jobs.push_back(frame_object(model, camera_from_object, view.tensor->intrinsics));
      tasks.jobs.back().view = std::uint32_t(v);
    }
  return tasks;
}

std::vector<ShadedView> shaded_views(const Scene& scene) {
  std::vector<ShadedView> shaded;
  for (const ObjectView& view : scene.views) {
    shaded.push_back({view.tensor, nullptr});
    if (!view.occluders) continue;
    const Camera& map = view.occluders->camera;
    shaded.back().known = scene.backend.make_depth(
        {view.occluders->depth_m, map.width, map.height, intrinsics_of(map)});
  }
  return shaded;
}

}  // namespace

Grid<Shading> shading(const Scene& scene, std::span<const ObjectPose> poses) {
  Grid<Shading> result(poses.size(), scene.views.size());
  const std::vector<ShadedView> views = shaded_views(scene);
  for (std::size_t object = 0; object < scene.models.size(); ++object) {
    const EdgeModel& model = scene.models[object];
    const Tasks tasks = tasks_of(scene, poses, object);
    if (tasks.jobs.empty()) continue;
    std::vector<ShadingSums> sums(tasks.jobs.size());
    scene.backend.shading_sums(views, model.triangle_mesh(), tasks.jobs,
                               float(occlusion_tolerance_m(model)), sums);
    for_each_in_chunks(scene.backend.threads(), sums.size(), 16, [&](std::size_t i) {
      result(tasks.list[i].pose, tasks.list[i].view) = explain(sums[i]);
    });
  }
  return result;
}

}  // namespace edgescout
