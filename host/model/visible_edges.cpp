#include "host/model/visible_edges.h"

#include <algorithm>
#include <cmath>

#include "host/core/options.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// A pinhole at the camera's place whose square image just holds the object's bounding sphere.
Intrinsics frame_object(const EdgeModel& model, const Se3& camera_from_object, int size) {
  const Eigen::Vector3d center = camera_from_object * model.center_m;
  const double reach = std::max(center.z() - model.radius_m, 0.05 * center.z());
  // Half the opening that contains the sphere, also far off the axis.
  const double half = 1.05 * model.radius_m / reach * (1 + center.head<2>().norm() / center.z());
  const double focal = 0.5 * (size - 3) / half;
  return {float(focal), float(focal), float(0.5 * (size - 1) - focal * center.x() / center.z()),
          float(0.5 * (size - 1) - focal * center.y() / center.z())};
}

struct Window {
  const float* depth;
  int size;
  Intrinsics k;
  // Whether one of the 3 x 3 pixels around the projection shows a surface as far as the point, or
  // none.
  bool shows(const Eigen::Vector3d& p, double tolerance_m) const {
    const double u = k.fx * p.x() / p.z() + k.cx + 0.5, v = k.fy * p.y() / p.z() + k.cy + 0.5;
    if (!(u >= 1 && v >= 1 && u < size - 1 && v < size - 1)) return true;
    const float* middle = depth + std::size_t(v) * std::size_t(size) + std::size_t(u);
    const double nearest_m = p.z() - tolerance_m;
    if (*middle >= nearest_m) return true;
    for (const float* row : {middle - size, middle, middle + size})
      for (int x = -1; x <= 1; ++x)
        if (row[x] >= nearest_m) return true;
    return false;
  }
  // Whether one of the 3 x 3 pixels shows the background.
  bool borders_background(const Eigen::Vector3d& p) const {
    const double u = k.fx * p.x() / p.z() + k.cx + 0.5, v = k.fy * p.y() / p.z() + k.cy + 0.5;
    if (!(u >= 1 && v >= 1 && u < size - 1 && v < size - 1)) return true;
    const float* middle = depth + std::size_t(v) * std::size_t(size) + std::size_t(u);
    for (const float* row : {middle - size, middle, middle + size})
      for (int x = -1; x <= 1; ++x)
        if (row[x] == DEPTH_EMPTY) return true;
    return false;
  }
};

// Collects the visible points of one pose.
struct VisiblePoints {
  Eigen::Matrix3d turn;
  Eigen::Vector3d shift_m;
  Window window;
  double tolerance_m;
  SilhouetteMarks* marks;  // may be null
  std::vector<ModelPoint> points;
  void add_visible(std::span<const RasterPoint> from) {
    for (const auto& [point_m, tangent] : from) {
      const Eigen::Vector3d in_camera = turn * point_m + shift_m;
      if (in_camera.z() <= 0 || !window.shows(in_camera, tolerance_m)) continue;
      points.push_back({float(point_m.x()), float(point_m.y()), float(point_m.z()),
                        float(tangent.x()), float(tangent.y()), float(tangent.z())});
      if (marks) marks->push_back(window.borders_background(in_camera));
    }
  }
};

// The contour of a curved surface inside one triangle: where the interpolated normal is
// perpendicular to the line of sight.
bool contour_in_triangle(const EdgeModel& model, int triangle, const Eigen::Vector3d& eye,
                         Eigen::Vector3d ends[2]) {
  double facing[3];
  const auto& corners = model.mesh.triangles[triangle];
  for (int c = 0; c < 3; ++c)
    facing[c] = model.corner_normals[triangle][c].dot(eye - model.mesh.vertices_m[corners[c]]);
  int found = 0;
  for (int c = 0; c < 3 && found < 2; ++c) {
    const double a = facing[c], b = facing[(c + 1) % 3];
    if ((a < 0) == (b < 0)) continue;
    const double s = a / (a - b);
    ends[found++] = (1 - s) * model.mesh.vertices_m[corners[c]] +
                    s * model.mesh.vertices_m[corners[(c + 1) % 3]];
  }
  return found == 2;
}

std::vector<ModelPoint> points_of_pose(const EdgeModel& model, const Se3& pose,
                                       const Window& window, double tolerance_m,
                                       SilhouetteMarks* marks) {
  VisiblePoints visible{
      pose.rotation.toRotationMatrix(), pose.translation_m, window, tolerance_m, marks, {}};
  visible.add_visible(model.crease_points);
  const Eigen::Vector3d eye = inverse(pose).translation_m;
  std::vector<RasterPoint> contours;
  for (int triangle : model.curved) {
    Eigen::Vector3d ends[2];
    if (contour_in_triangle(model, triangle, eye, ends))
      add_raster_points(ends[0], ends[1], model.raster_step_m, contours);
  }
  visible.add_visible(contours);
  return std::move(visible.points);
}

}  // namespace

Intrinsics intrinsics_of(const Camera& c) {
  return {float(c.fx), float(c.fy), float(c.cx), float(c.cy)};
}

Pose to_pose(const Se3& b_from_a) {
  const Eigen::Matrix3d r = b_from_a.rotation.toRotationMatrix();
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.m[4 * i + j] = float(r(i, j));
    pose.m[4 * i + 3] = float(b_from_a.translation_m[i]);
  }
  return pose;
}

void VisibilityOptions::validate() const {
  const BoundsCheck in("visibility");
  in.require("depth_map_size", depth_map_size_px, 8, 4096);
  in.require("tolerance", tolerance, 0, 10);
}

std::vector<std::vector<ModelPoint>> visible_edges(const EdgeModel& model,
                                                   std::span<const Se3> camera_from_object,
                                                   Backend& backend,
                                                   const VisibilityOptions& options,
                                                   std::vector<SilhouetteMarks>* marks) {
  options.validate();
  const int size = options.depth_map_size_px;
  // Bounded memory however many poses there are.
  constexpr std::size_t chunk = 64;
  std::vector<float> depth;
  std::vector<DepthJob> jobs;
  std::vector<std::vector<ModelPoint>> result(camera_from_object.size());
  if (marks) marks->assign(camera_from_object.size(), {});
  for (std::size_t first = 0; first < camera_from_object.size(); first += chunk) {
    const std::size_t count = std::min(chunk, camera_from_object.size() - first);
    jobs.clear();
    for (std::size_t i = 0; i < count; ++i)
      jobs.push_back({to_pose(camera_from_object[first + i]),
                      frame_object(model, camera_from_object[first + i], size)});
    depth.resize(count * size * size);
    backend.depth_raster(model.triangle_mesh(), jobs, size, size, depth);
    backend.threads().for_each(count, [&](std::size_t i) {
      const Se3& pose = camera_from_object[first + i];
      if ((pose * model.center_m).z() <= model.radius_m * 0.05) return;
      const Window window{depth.data() + i * size * size, size, jobs[i].intrinsics};
      result[first + i] =
          points_of_pose(model, pose, window, options.tolerance * model.mesh.diameter_m,
                         marks ? &(*marks)[first + i] : nullptr);
    });
  }
  return result;
}

}  // namespace edgescout
