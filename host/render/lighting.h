// Computes the triangles of a scene in the world frame and the light that reaches a point on them.
#pragma once

#include <span>
#include <vector>

#include "host/render/raster.h"
#include "host/render/scene.h"

namespace edgescout {

struct WorldTriangles {
  std::vector<TriangleCorners> corners_m;
  std::vector<TriangleCorners>
      normals;              // unit; smoothed over the surface up to creases of 35 degrees
  std::vector<int> placed;  // index into SimulatedScene::placed
};

WorldTriangles world_triangles(const SimulatedScene& scene);

struct ReceivedLight {
  double diffuse = 0;   // irradiance; times the albedo it is what the camera sees; 1 is white
  double specular = 0;  // added to that
};

class Lighting {
 public:
  // Draws one shadow map per light if the options ask for shadows. `scene` must outlive this.
  Lighting(const SimulatedScene& scene, const WorldTriangles& triangles, ThreadPool& pool);

  // `normal` and `to_viewer`: unit, on the same side of the surface.
  ReceivedLight at(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal,
                   const Eigen::Vector3d& to_viewer, const Material& material) const;

 private:
  struct ShadowMap {
    int size_px = 0;
    Eigen::Matrix<double, 3, 4> pixel_from_world;  // homogeneous: [u z, v z, z]
    std::vector<float> depth_m;
    double texel_m = 0;  // at the scene
  };
  double lit_fraction(const ShadowMap& map, const Eigen::Vector3d& point_m,
                      const Eigen::Vector3d& normal) const;

  const SimulatedScene& scene_;
  std::vector<ShadowMap> maps_;  // one per light, or none
};

}  // namespace edgescout
