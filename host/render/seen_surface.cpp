#include "host/render/seen_surface.h"

namespace edgescout {

ViewRaster rasterize_view(const SimulatedScene& scene, const WorldTriangles& triangles,
                          const SceneView& view, ThreadPool& pool) {
  const Camera fine = scaled(view.camera, scene.options.supersampling);
  return {scene, triangles, fine, inverse(view.camera_from_world),
          rasterize(triangles, fine, view.camera_from_world, pool)};
}

SeenSurface seen_at(const ViewRaster& view, int x, int y) {
  const std::size_t i = static_cast<std::size_t>(y) * view.fine.width + x;
  const Eigen::Vector3d ray =
      view.world_from_camera.rotation * ray_through(view.fine, Eigen::Vector2d(x, y));
  const Eigen::Vector3d& eye = view.world_from_camera.translation_m;
  SeenSurface seen;
  seen.triangle = view.raster.triangle[i];
  seen.to_viewer = -ray.normalized();
  if (seen.triangle >= 0) {
    seen.depth_m = view.raster.depth_m[i];
    seen.point_m = eye + seen.depth_m * ray;
    seen.normal = view.triangles.normal_at(seen.triangle, seen.point_m);
    if (seen.normal.dot(seen.to_viewer) < 0) seen.normal = -seen.normal;
  } else if (ray.z() < -1e-6) {
    seen.triangle = PLANE;
    seen.depth_m = -eye.z() / ray.z();
    seen.point_m = eye + seen.depth_m * ray;
    seen.normal = Eigen::Vector3d::UnitZ();
  } else {
    seen.triangle = HORIZON;
  }
  return seen;
}

const Material& material_of(const ViewRaster& view, const SeenSurface& seen) {
  if (seen.triangle == PLANE) return view.scene.board_material;
  return view.scene.placed[view.triangles.placed[seen.triangle]].material;
}

ShadedPoint shaded_point(const ViewRaster& view, const SeenSurface& seen) {
  ShadedPoint surface{seen.point_m, seen.normal, seen.to_viewer};
  if (seen.triangle >= 0)
    surface.grain =
        view.scene.placed[view.triangles.placed[seen.triangle]].world_from_object.rotation *
        Eigen::Vector3d::UnitX();
  return surface;
}

}  // namespace edgescout
