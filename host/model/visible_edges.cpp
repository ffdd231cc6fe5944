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

std::vector<RasterPoint> contour_points(const EdgeModel& model, const Se3& camera_from_object) {
  const Eigen::Vector3d eye = inverse(camera_from_object).translation_m;
  std::vector<RasterPoint> points;
  for (const int triangle : model.curved) {
    Eigen::Vector3d ends[2];
    if (contour_in_triangle(model, triangle, eye, ends))
      add_raster_points(ends[0], ends[1], model.raster_step_m, points);
  }
  return points;
}

void append_positions(std::span<const RasterPoint> points, std::vector<float>& positions_m) {
  for (const RasterPoint& point : points)
    for (const double coordinate_m : point.point_m) positions_m.push_back(float(coordinate_m));
}

// The poses of one call of point_visibility: a model's crease points, and of each pose the contour
// points that it shows.
class Candidates {
 public:
  Candidates(const EdgeModel& model, std::span<const Se3> camera_from_object, Backend& backend,
             const VisibilityOptions& options, bool with_surfaces)
      : model_(model), contours_(camera_from_object.size()) {
    backend.threads().for_each(contours_.size(), [&](std::size_t i) {
      contours_[i] = contour_points(model, camera_from_object[i]);
    });
    std::vector<float> positions_m;
    append_positions(model.crease_points, positions_m);
    if (with_surfaces)
      for (const SurfacePoint& point : model.surface_points)
        positions_m.insert(positions_m.end(), {point.x_m, point.y_m, point.z_m});
    const auto shared = std::uint32_t(positions_m.size() / 3);
    std::vector<VisibilityJob> jobs;
    for (std::size_t i = 0; i < contours_.size(); ++i) {
      jobs.push_back({to_pose(camera_from_object[i]),
                      frame_object(model, camera_from_object[i], options.depth_map_size_px),
                      float(options.tolerance * model.mesh.diameter_m),
                      std::uint32_t(positions_m.size() / 3), std::uint32_t(contours_[i].size())});
      append_positions(contours_[i], positions_m);
    }
    const VisibilityPoints points{positions_m, shared};
    flags_.resize(flag_count(points, jobs));
    backend.point_visibility(model.triangle_mesh(), points, jobs, options.depth_map_size_px,
                             flags_);
    for (const VisibilityJob& job : jobs)
      first_flags_.push_back(first_flags_.back() + points.shared + job.point_count);
  }

  // Of the i-th pose. `marks` and `surface` may be null; the latter is not without `with_surfaces`.
  std::vector<ModelPoint> visible(std::size_t i, SilhouetteMarks* marks,
                                  std::vector<SurfacePoint>* surface) const {
    std::vector<ModelPoint> points;
    const std::uint8_t* flags = flags_.data() + first_flags_[i];
    const auto add = [&](std::span<const RasterPoint> from) {
      for (const auto& [point_m, tangent] : from) {
        const std::uint8_t flag = *flags++;
        if (!(flag & POINT_VISIBLE)) continue;
        points.push_back({float(point_m.x()), float(point_m.y()), float(point_m.z()),
                          float(tangent.x()), float(tangent.y()), float(tangent.z())});
        if (marks) marks->push_back(flag & POINT_BORDERS_BACKGROUND ? 1 : 0);
      }
    };
    add(model_.crease_points);
    if (surface)
      for (const SurfacePoint& point : model_.surface_points)
        if (*flags++ == POINT_VISIBLE) surface->push_back(point);
    add(contours_[i]);
    return points;
  }

 private:
  const EdgeModel& model_;
  std::vector<std::vector<RasterPoint>> contours_;  // by pose
  std::vector<std::uint8_t> flags_;
  std::vector<std::size_t> first_flags_{0};
};

}  // namespace

void VisibilityOptions::validate() const {
  const BoundsCheck in("visibility");
  in.require("depth_map_size", depth_map_size_px, 8, 4096);
  in.require("tolerance", tolerance, 0, 10);
}

std::vector<std::vector<ModelPoint>> visible_edges(const EdgeModel& model,
                                                   std::span<const Se3> camera_from_object,
                                                   Backend& backend,
                                                   const VisibilityOptions& options,
                                                   std::vector<SilhouetteMarks>* marks,
                                                   VisibleSurfaces* surfaces) {
  options.validate();
  std::vector<std::vector<ModelPoint>> result(camera_from_object.size());
  if (marks) marks->assign(camera_from_object.size(), {});
  if (surfaces) surfaces->assign(camera_from_object.size(), {});
  std::vector<std::size_t> in_front;
  for (std::size_t i = 0; i < camera_from_object.size(); ++i)
    if ((camera_from_object[i] * model.center_m).z() > model.radius_m * 0.05) in_front.push_back(i);
  // Bounded memory however many poses there are.
  constexpr std::size_t chunk = 512;
  for (std::size_t first = 0; first < in_front.size(); first += chunk) {
    const auto indices =
        std::span(in_front).subspan(first, std::min(chunk, in_front.size() - first));
    std::vector<Se3> poses;
    for (const std::size_t i : indices) poses.push_back(camera_from_object[i]);
    const Candidates candidates(model, poses, backend, options, surfaces != nullptr);
    backend.threads().for_each(indices.size(), [&](std::size_t k) {
      const std::size_t i = indices[k];
      result[i] = candidates.visible(k, marks ? &(*marks)[i] : nullptr,
                                     surfaces ? &(*surfaces)[i] : nullptr);
    });
  }
  return result;
}

}  // namespace edgescout
