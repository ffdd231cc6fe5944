#include "host/register/shading.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "host/model/visible_edges.h"
#include "host/register/occluders.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int WINDOW_PX = 96;  // square depth map of the object
// Image pixels between pixels of the map. Blur at a silhouette must not reach the next pixel
// inside.
constexpr int FEWEST_STRIDE = 2;
// Relative second difference of inverse depth. A larger one is an edge or another surface.
constexpr double LARGEST_BEND = 4e-3;
constexpr int HARMONICS = 9;
constexpr double FEWEST_PIXELS = 60;  // nine harmonics explain any grey of fewer pixels
using Harmonics = Eigen::Matrix<double, HARMONICS, 1>;

// Part of the image: window pixel (i, j) is image pixel (x + stride i, y + stride j). Samples need
// no interpolation.
struct Window {
  int x = 0, y = 0, stride = FEWEST_STRIDE;
};

Window frame_object(const EdgeModel& model, const Se3& camera_from_object, const Intrinsics& k) {
  const Eigen::Vector3d center = camera_from_object * model.center_m;
  const double reach = std::max(center.z() - model.radius_m, 0.05 * center.z());
  const double half_px =
      std::max(k.fx, k.fy) * model.radius_m / reach * (1 + center.head<2>().norm() / center.z());
  const int stride = std::clamp(int(std::ceil(2 * half_px / (WINDOW_PX - 4))), FEWEST_STRIDE, 1000);
  const double left = k.fx * center.x() / center.z() + k.cx - 0.5 * stride * WINDOW_PX,
               top = k.fy * center.y() / center.z() + k.cy - 0.5 * stride * WINDOW_PX;
  const auto whole = [](double v) { return int(std::clamp(std::round(v), -1e6, 1e6)); };
  return {whole(left), whole(top), stride};
}

Intrinsics intrinsics_of(const Window& w, const Intrinsics& k) {
  const float s = 1.0f / float(w.stride);
  return {k.fx * s, k.fy * s, (k.cx - float(w.x)) * s, (k.cy - float(w.y)) * s};
}

Harmonics harmonics(const Eigen::Vector3d& n) {
  Harmonics h;
  h << 1, n.x(), n.y(), n.z(), n.x() * n.y(), n.y() * n.z(), n.z() * n.x(),
      n.x() * n.x() - n.y() * n.y(), 3 * n.z() * n.z() - 1;
  return h;
}

// The normal at an inner pixel of a depth map. On a plane n . X = d inverse depth is linear in the
// pixel: 1 / z = n . (u, v, 1) / d. False where the nine pixels around are not one smooth surface.
bool normal_at(const float* depth, int i, int j, const Intrinsics& k, Eigen::Vector3d& normal) {
  double w[3][3];
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const float z = depth[std::size_t(j + y) * WINDOW_PX + i + x];
      if (z == DEPTH_EMPTY) return false;
      w[y + 1][x + 1] = 1 / double(z);
    }
  const double middle = w[1][1];
  const double bend =
      std::max(std::abs(w[1][0] + w[1][2] - 2 * middle), std::abs(w[0][1] + w[2][1] - 2 * middle));
  if (bend > LARGEST_BEND * middle) return false;
  const double a = 0.5 * (w[1][2] - w[1][0]) * k.fx, b = 0.5 * (w[2][1] - w[0][1]) * k.fy;
  const double c = middle - a * (i - k.cx) / k.fx - b * (j - k.cy) / k.fy;
  normal = Eigen::Vector3d(a, b, c).normalized();
  return true;
}

// A pixel of the depth map as a point in the camera frame.
Eigen::Vector3d point_at(const float* depth, int i, int j, const Intrinsics& k) {
  const double z = depth[std::size_t(j) * WINDOW_PX + i];
  return {(i - k.cx) / k.fx * z, (j - k.cy) / k.fy * z, z};
}

// Sums for the least squares of grey on the harmonics, by its normal equations.
struct GreySums {
  Eigen::Matrix<double, HARMONICS, HARMONICS> system =
      Eigen::Matrix<double, HARMONICS, HARMONICS>::Zero();
  Harmonics right = Harmonics::Zero();
  double count = 0, sum = 0, squares = 0;

  void add(const Eigen::Vector3d& normal, double grey) {
    const Harmonics h = harmonics(normal);
    system.selfadjointView<Eigen::Lower>().rankUpdate(h);
    right += grey * h;
    count += 1, sum += grey, squares += grey * grey;
  }

  Shading explain() {
    if (count < FEWEST_PIXELS) return {};
    system.diagonal().array() += 1e-6 * count;  // few faces leave harmonics undetermined
    const Harmonics best = system.selfadjointView<Eigen::Lower>().ldlt().solve(right);
    const double about_mean = squares - sum * sum / count;
    return {count, about_mean, std::clamp(squares - best.dot(right), 0.0, about_mean)};
  }
};

// `depth` is the map of the window, `k` its intrinsics.
Shading explain(const ObjectView& view, const Window& window, const float* depth,
                const Intrinsics& k, double tolerance_m) {
  const Image& image = *view.image;
  GreySums sums;
  for (int j = 1; j + 1 < WINDOW_PX; ++j)
    for (int i = 1; i + 1 < WINDOW_PX; ++i) {
      if (depth[std::size_t(j) * WINDOW_PX + i] == DEPTH_EMPTY) continue;
      const int x = window.x + window.stride * i, y = window.y + window.stride * j;
      Eigen::Vector3d normal;
      if (x < 0 || y < 0 || x >= image.width || y >= image.height ||
          !normal_at(depth, i, j, k, normal))
        continue;
      if (view.occluders && view.occluders->may_hide(point_at(depth, i, j, k), tolerance_m))
        continue;
      sums.add(normal, image.at(x, y));
    }
  return sums.explain();
}

// Windows of one object's poses in all views, with the depth maps that they need.
struct Tasks {
  struct Task {
    Window window;
    std::size_t pose, view;
  };
  std::vector<Task> list;
  std::vector<DepthJob> jobs;
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
      const Window window = frame_object(model, camera_from_object, view.tensor->intrinsics);
      tasks.list.push_back({window, p, v});
      tasks.jobs.push_back(
          {to_pose(camera_from_object), intrinsics_of(window, view.tensor->intrinsics)});
    }
  return tasks;
}

void explain_all(Grid<Shading>& result, const Scene& scene, const Tasks& tasks,
                 const EdgeModel& model) {
  constexpr std::size_t chunk = 256;  // bounds the memory however many poses there are
  constexpr std::size_t map = std::size_t(WINDOW_PX) * WINDOW_PX;
  const double tolerance_m = occlusion_tolerance_m(model);
  Unfilled<float> depth;
  for (std::size_t first = 0; first < tasks.list.size(); first += chunk) {
    const std::size_t count = std::min(chunk, tasks.list.size() - first);
    depth.resize(count * map);
    scene.backend.depth_raster(model.triangle_mesh(), std::span(tasks.jobs).subspan(first, count),
                               WINDOW_PX, WINDOW_PX, depth);
    scene.backend.threads().for_each(count, [&](std::size_t i) {
      const Tasks::Task& task = tasks.list[first + i];
      result(task.pose, task.view) =
          explain(scene.views[task.view], task.window, depth.data() + i * map,
                  tasks.jobs[first + i].intrinsics, tolerance_m);
    });
  }
}

}  // namespace

Grid<Shading> shading(const Scene& scene, std::span<const ObjectPose> poses) {
  Grid<Shading> result(poses.size(), scene.views.size());
  for (std::size_t object = 0; object < scene.models.size(); ++object)
    explain_all(result, scene, tasks_of(scene, poses, object), scene.models[object]);
  return result;
}

}  // namespace edgescout
