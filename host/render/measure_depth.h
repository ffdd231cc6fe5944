// Makes the depth image that a sensor measures of a view.
//
// In this order, from the true depth at the pixels' centres: borders are smeared, noise is added,
// steps are taken, the bias is added; then come the holes, then the wrong rotation. Each error has
// a random stream of its own: switching one on changes no other.
#pragma once

#include "host/core/depth_image.h"
#include "host/render/pixel_shader.h"

namespace edgescout {

// `grey`: what the camera made of the same view, which is number `number` of its scene. The lens
// moves depth as it moved the image.
DepthImage measure_depth(const ViewRaster& view, const SceneView& scene_view,
                         const SceneShading& shading, const Image& grey, std::size_t number,
                         ThreadPool& pool);

}  // namespace edgescout
