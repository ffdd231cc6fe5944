// Computes the light that lamps and sky send to a point of a scene.
#pragma once

#include <vector>

#include "host/render/microfacets.h"
#include "host/render/scene.h"
#include "host/render/world_triangles.h"

namespace edgescout {

struct ReceivedLight {
  double diffuse = 0;   // irradiance; times the albedo it is what the camera sees; 1 is white
  double specular = 0;  // added to that
};

class Lighting {
 public:
  // Draws one shadow map per light if the options ask for shadows. `scene` must outlive this.
  Lighting(const SimulatedScene& scene, const WorldTriangles& triangles, ThreadPool& pool);

  ReceivedLight at(const ShadedPoint& surface, const Material& material) const;
  // The diffuse part alone.
  double diffuse(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal) const;
  // The same from an eighth of the lights, times eight. The mean over the eighths, 0 to 7, is
  // diffuse(): for what takes the mean of several samples anyway.
  double diffuse_by_eighth(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal,
                           int eighth) const;
  // The same, over what it would be without shadows.
  double lit_share(const Eigen::Vector3d& point_m, const Eigen::Vector3d& normal) const;

 private:
  struct ShadowMap {
    int size_px = 0;
    Eigen::Matrix<double, 3, 4> pixel_from_world;  // homogeneous: [u z, v z, z]
    std::vector<float> depth_m;
    double texel_m = 0;  // at the scene
  };
  double lit_fraction(const ShadowMap& map, const Eigen::Vector3d& point_m,
                      const Eigen::Vector3d& normal) const;
  // What arrives from one light, without shadows; 0: from behind the surface.
  struct Beam {
    Eigen::Vector3d to_light;  // unit
    double irradiance = 0;
  };
  static Beam beam_of(const Light& light, const Eigen::Vector3d& point_m,
                      const Eigen::Vector3d& normal);
  Beam shadowed_beam(std::size_t light, const Eigen::Vector3d& point_m,
                     const Eigen::Vector3d& normal) const;

  const SimulatedScene& scene_;
  std::vector<ShadowMap> maps_;  // one per light, or none
};

}  // namespace edgescout
