// The triangles of a scene in the world frame, with smooth normals.
#pragma once

#include <array>
#include <vector>

#include "host/render/raster.h"
#include "host/render/scene.h"

namespace edgescout {

struct WorldTriangles : Triangles {
  explicit WorldTriangles(const SimulatedScene& scene);  // `scene` must outlive this

  std::vector<int> placed;  // of each triangle: index into SimulatedScene::placed
  std::vector<int> first;   // of each placed object; its mesh's triangles follow in order

  // Unit normal at a point of a triangle, interpolated over the surface up to creases of 35
  // degrees.
  Eigen::Vector3d normal_at(int triangle, const Eigen::Vector3d& point_m) const;

 private:
  using CornerNormals = std::array<Eigen::Vector3d, 3>;
  static std::vector<CornerNormals> smooth_normals(const Mesh& mesh);
  const SimulatedScene& scene_;
  std::vector<std::vector<CornerNormals>> normals_;  // of each object's triangles, object frame
};

}  // namespace edgescout
