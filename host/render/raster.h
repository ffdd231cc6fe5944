// A z-buffer that remembers which triangle each sample belongs to.
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
  std::vector<float> depth_m;  // camera-frame z at the pixel's centre; infinity where nothing is
  std::vector<int> triangle;   // -1 where nothing is
};

// Both windings are drawn. A triangle with a corner nearer than 1 mm is dropped. Samples sit at
// integer pixels.
Raster rasterize(std::span<const TriangleCorners> x_in_world, const Camera& camera,
                 const Se3& camera_from_world, ThreadPool& pool);

}  // namespace edgescout
