// Internal to the depth sensor: one view as it sees it.
#pragma once

#include <vector>

#include "host/core/random.h"
#include "host/render/pixel_shader.h"

namespace edgescout {

struct SensedView {
  const ViewRaster& view;
  const SceneView& scene_view;
  const SceneShading& shading;
  const Image& grey;                  // what the camera made of the view
  std::size_t number = 0;             // of the view in its scene
  std::vector<SeenSurface> surfaces;  // per pixel, of what its centre sees through the lens

  const DepthSensor& sensor() const { return view.scene.options.depth; }
  // Each error has a stream of its own, so switching one on changes no other.
  Random stream(std::string_view error) const {
    return Random(view.scene.options.seed).split(error).split(number);
  }
  bool is_part(std::size_t i) const { return surfaces[i].triangle >= 0; }
};

}  // namespace edgescout
