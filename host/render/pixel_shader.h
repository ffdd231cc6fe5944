// Computes the light that the pixels of a view receive.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "host/render/board_plane.h"
#include "host/render/lighting.h"
#include "host/render/reflection.h"
#include "host/render/seen_surface.h"

namespace edgescout {

// What all views of a scene share.
struct SceneShading {
  SceneShading(const SimulatedScene& scene, ThreadPool& pool);  // `scene` must outlive this
  SceneShading(const SceneShading&) = delete;  // the reflections refer to the other members
  SceneShading& operator=(const SceneShading&) = delete;
  WorldTriangles triangles;
  Lighting lighting;
  BoardPlane plane;
  std::optional<Reflections> reflections;  // if the scene has an environment
};

// Direct light is computed once per surface and pixel. The print, which is finer, and reflections
// are computed once per sample. One shader serves one thread.
class PixelShader {
 public:
  // All must outlive this.
  PixelShader(const ViewRaster& view, const SceneView& scene_view, const SceneShading& shading)
      : view_(view), scene_view_(scene_view), shading_(shading) {}

  // Mean light of one pixel's samples; 1 is white.
  double shade(int x, int y);

 private:
  struct Pixel {
    int x = 0, y = 0, sample = 0;
  };
  double light_of(const SeenSurface& seen, const Pixel& pixel);
  bool is_background(const SeenSurface& seen) const;
  double light_of_background(const SeenSurface& seen, const Pixel& pixel);
  double reflected(const ShadedPoint& surface, const Material& material, const Pixel& pixel) const;
  ReceivedLight received(int triangle, const ShadedPoint& surface, const Material& material);

  const ViewRaster& view_;
  const SceneView& scene_view_;
  const SceneShading& shading_;
  std::vector<std::pair<int, ReceivedLight>> received_;  // by triangle, in this pixel
  std::optional<double> lit_share_;                      // of the background in this pixel
};

}  // namespace edgescout
