// The surfaces that depth images measured, as triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "host/core/camera.h"
#include "host/core/depth_image.h"
#include "host/core/se3.h"
#include "kernels/depth_raster.h"

namespace edgescout {

// Two triangles between four neighbouring pixels, without those of which a corner was not measured
// or whose corners' depths differ by more than `largest_step` of the largest: there an object ends.
class DepthSurface {
 public:
  // `camera` has no lens. Vertices are mapped by `frame_from_camera`.
  void add(const DepthImage& depth, const Camera& camera, const Se3& frame_from_camera,
           float largest_step);
  bool is_empty() const { return triangles_.empty(); }
  TriangleMesh mesh() const { return {vertices_m_, triangles_}; }

 private:
  std::vector<float> vertices_m_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace edgescout
