// Draws triangles into a z-buffer that also stores the triangle of each sample.
#pragma once

#include <array>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

class ThreadPool;

// Triangles that share their corners.
struct Triangles {
  std::vector<Eigen::Vector3d> vertices_m;
  std::vector<std::array<int, 3>> corners;  // indices into vertices_m
  // Appends those of a mesh.
  void add(const Mesh& mesh, const Se3& frame_from_mesh);
};

struct Raster {
  int width = 0;
  int height = 0;
  std::vector<float> depth_m;  // camera-frame z at the pixel's centre; infinity without a surface
  std::vector<int> triangle;   // -1 without a surface
};

// Draws triangles of both orientations. A triangle with a corner nearer than 1 mm is dropped.
// Samples are at integer pixels.
Raster rasterize(const Triangles& in_world, const Camera& camera, const Se3& camera_from_world,
                 ThreadPool& pool);

}  // namespace edgescout
