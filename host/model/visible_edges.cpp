#include "host/model/visible_edges.h"

#include <algorithm>
#include <cmath>

#include "host/core/option_bounds.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// A pinhole at the camera's place whose square image just holds the object's bounding sphere.
Intrinsics frame_object(const EdgeModel& model, const Se3& camera_from_object, int size) {
  const Eigen::Vector3d center = camera_from_object * model.center_m;
  const double reach = std::max(center.z() - model.radius_m, 0.05 * center.z());
  // Half the opening that holds the sphere however far off the axis it lies.
  const double half = 1.05 * model.radius_m / reach * (1 + center.head<2>().norm() / center.z());
  const double focal = 0.5 * (size - 3) / half;
  return {float(focal), float(focal), float(0.5 * (size - 1) - focal * center.x() / center.z()),
          float(0.5 * (size - 1) - focal * center.y() / center.z())};
}

struct Window {
  const float* depth;
  int size;
  Intrinsics k;
  // Farthest surface in the 3 x 3 pixels around the projection.
  double farthest_around(const Eigen::Vector3d& p) const {
    const int u = int(std::lround(k.fx * p.x() / p.z() + k.cx)),
              v = int(std::lround(k.fy * p.y() / p.z() + k.cy));
    float farthest = 0;
    for (int y = v - 1; y <= v + 1; ++y)
      for (int x = u - 1; x <= u + 1; ++x) {
        if (x < 0 || y < 0 || x >= size || y >= size) return DEPTH_EMPTY;
        farthest = std::max(farthest, depth[std::size_t(y) * size + x]);
      }
    return farthest;
  }
};

void sample_segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const EdgeModel& model,
                    const Se3& pose, const Window& window, double tolerance_m,
                    std::vector<ModelPoint>& points) {
  const Eigen::Vector3d along = to - from;
  const double length = along.norm();
  if (length <= 0) return;
  const Eigen::Vector3d tangent = along / length;
  // Short segments (a finely tessellated curve) get a point with the probability of their length, decided by
  // where they lie, so that curves are sampled as densely as straight edges and equally in every run.
  const double exact = length / model.raster_step_m;
  const double dither = std::fmod(
      std::abs(from.dot(Eigen::Vector3d(12.9898, 78.233, 37.719)) / model.raster_step_m) * 43.7585453, 1.0);
  const int count = static_cast<int>(std::floor(exact + dither));
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d x = from + along * ((i + 0.5) / count);
    const Eigen::Vector3d in_camera = pose * x;
    if (in_camera.z() <= 0 || in_camera.z() > window.farthest_around(in_camera) + tolerance_m) continue;
    points.push_back({float(x.x()), float(x.y()), float(x.z()), float(tangent.x()), float(tangent.y()),
                      float(tangent.z())});
  }
}

// The contour of a curved surface inside one triangle: where the interpolated normal is perpendicular to the
// line of sight.
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
    ends[found++] =
        (1 - s) * model.mesh.vertices_m[corners[c]] + s * model.mesh.vertices_m[corners[(c + 1) % 3]];
  }
  return found == 2;
}

std::vector<ModelPoint> points_of_pose(const EdgeModel& model, const Se3& pose, const Window& window,
                                       double tolerance_m) {
  std::vector<ModelPoint> points;
  for (const EdgeModel::Segment& crease : model.creases)
    sample_segment(crease.from_m, crease.to_m, model, pose, window, tolerance_m, points);
  const Eigen::Vector3d eye = inverse(pose).translation_m;
  for (int triangle : model.curved) {
    Eigen::Vector3d ends[2];
    if (contour_in_triangle(model, triangle, eye, ends))
      sample_segment(ends[0], ends[1], model, pose, window, tolerance_m, points);
  }
  return points;
}

}  // namespace

Intrinsics intrinsics_of(const Camera& c) { return {float(c.fx), float(c.fy), float(c.cx), float(c.cy)}; }

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
  const OptionBounds in("visibility");
  in("depth_map_size", depth_map_size_px, 8, 4096);
  in("tolerance", tolerance, 0, 10);
}

std::vector<std::vector<ModelPoint>> visible_edges(const EdgeModel& model,
                                                   std::span<const Se3> camera_from_object, Backend& backend,
                                                   const VisibilityOptions& options) {
  options.validate();
  const int size = options.depth_map_size_px;
  // Bounded memory however many poses there are.
  constexpr std::size_t chunk = 64;
  std::vector<float> depth;
  std::vector<DepthJob> jobs;
  std::vector<std::vector<ModelPoint>> result(camera_from_object.size());
  for (std::size_t first = 0; first < camera_from_object.size(); first += chunk) {
    const std::size_t count = std::min(chunk, camera_from_object.size() - first);
    jobs.clear();
    for (std::size_t i = 0; i < count; ++i)
      jobs.push_back(
          {to_pose(camera_from_object[first + i]), frame_object(model, camera_from_object[first + i], size)});
    depth.resize(count * size * size);
    backend.depth_raster(model.triangle_mesh(), jobs, size, size, depth);
    backend.threads().for_each(count, [&](std::size_t i) {
      const Se3& pose = camera_from_object[first + i];
      if ((pose * model.center_m).z() <= model.radius_m * 0.05) return;
      const Window window{depth.data() + i * size * size, size, jobs[i].intrinsics};
      result[first + i] = points_of_pose(model, pose, window, options.tolerance * model.mesh.diameter_m);
    });
  }
  return result;
}

}  // namespace edgescout
