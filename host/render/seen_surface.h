// What each sample of a view sees: a part, the plane of the board, or nothing.
#pragma once

#include <limits>

#include "host/render/lighting.h"
#include "host/render/raster.h"
#include "host/render/scene.h"

namespace edgescout {

constexpr int PLANE = -1, HORIZON = -2;

struct SeenSurface {
  int triangle = HORIZON;                      // index into WorldTriangles, or PLANE
  Eigen::Vector3d point_m, normal, to_viewer;  // world frame; unit vectors on the viewer's side
  double depth_m = std::numeric_limits<double>::infinity();  // camera-frame z
};

// A view with its z-buffer.
struct ViewRaster {
  const SimulatedScene& scene;
  const WorldTriangles& triangles;
  Camera fine;  // of the supersampled image
  Se3 world_from_camera;
  Raster raster;  // of `fine`
};

ViewRaster rasterize_view(const SimulatedScene& scene, const WorldTriangles& triangles,
                          const SceneView& view, ThreadPool& pool);

// (x, y): a pixel of the supersampled image.
SeenSurface seen_at(const ViewRaster& view, int x, int y);

// Of a part or the plane.
const Material& material_of(const ViewRaster& view, const SeenSurface& seen);
ShadedPoint shaded_point(const ViewRaster& view, const SeenSurface& seen);

}  // namespace edgescout
