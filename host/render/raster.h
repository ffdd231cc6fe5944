// Draws triangles into a z-buffer that also stores the triangle of each sample.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

class ThreadPool;

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

struct Raster {
  int width = 0;
  int height = 0;
  std::vector<float> depth_m;  // camera-frame z at the pixel's centre; infinity without a surface
  std::vector<int> triangle;   // -1 without a surface
};

// Draws triangles of both orientations. A triangle with a corner nearer than 1 mm is dropped.
// Samples are at integer pixels.
Raster rasterize(std::span<const TriangleCorners> x_in_world, const Camera& camera,
                 const Se3& camera_from_world, ThreadPool& pool);

}  // namespace edgescout
