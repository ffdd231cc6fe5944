#include "host/render/projector_shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

// A camera in the projector's place whose image is so much wider that it holds all that the grey
// camera sees.
SceneView projector_view(const SceneView& scene_view, double nearest_m, double baseline_m) {
  SceneView projector;
  projector.camera = scene_view.camera;
  projector.camera_from_world =
      Se3{Eigen::Quaterniond::Identity(), {-baseline_m, 0, 0}} * scene_view.camera_from_world;
  const double shift_px = projector.camera.fx * std::abs(baseline_m) / nearest_m;
  const int more = std::min(4 * projector.camera.width, static_cast<int>(std::ceil(shift_px)) + 2);
  projector.camera.width += more;
  if (baseline_m > 0) projector.camera.cx += more;
  return projector;
}

}  // namespace

std::vector<char> lit_by_projector(const ViewRaster& view, const SceneView& scene_view,
                                   const std::vector<SeenSurface>& surfaces, double baseline_m,
                                   ThreadPool& pool) {
  std::vector<char> lit(surfaces.size(), true);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const SeenSurface& seen : surfaces) nearest_m = std::min(nearest_m, seen.depth_m);
  if (!std::isfinite(nearest_m)) return lit;
  const SceneView projector = projector_view(scene_view, nearest_m, baseline_m);
  const Camera& camera = projector.camera;
  const Raster raster = rasterize(view.triangles, camera, projector.camera_from_world, pool);
  const Eigen::Vector3d place_m = inverse(projector.camera_from_world).translation_m;
  for_each_in_chunks(pool, surfaces.size(), 4096, [&](std::size_t i) {
    const SeenSurface& seen = surfaces[i];
    if (seen.triangle == HORIZON) return;
    if (seen.normal.dot(place_m - seen.point_m) <= 0) {
      lit[i] = false;
      return;
    }
    // The point is moved off the surface by one pixel, else the surface would shade itself.
    const double pixel_m = seen.depth_m / camera.fx;
    const Eigen::Vector3d x =
        projector.camera_from_world * (seen.point_m + 1.5 * pixel_m * seen.normal);
    const Eigen::Vector2d pixel = project(camera, x).array().round();
    if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < camera.width &&
          pixel.y() < camera.height))
      return;
    const std::size_t j =
        static_cast<std::size_t>(pixel.y()) * camera.width + static_cast<std::size_t>(pixel.x());
    lit[i] = raster.depth_m[j] >= x.z() - pixel_m;
  });
  return lit;
}

}  // namespace edgescout
