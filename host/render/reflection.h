// The light that metal and gloss mirror towards the viewer: surroundings, board and other parts.
//
// Each sample follows one ray. What a ray meets is taken as matt, or as an even mirror of the
// surroundings: there is no second reflection.
#pragma once

#include "host/render/board_plane.h"
#include "host/render/lighting.h"
#include "host/render/microfacets.h"
#include "host/render/scene_rays.h"

namespace edgescout {

// One of `count` samples of a pixel. `u` and `v` are spread over the unit square, `eighth` over the
// lights of what is mirrored (Lighting::diffuse_by_eighth).
struct LobeSample {
  double u = 0, v = 0;
  int count = 1;
  int eighth = 0;
};

class Reflections {
 public:
  // All must outlive this. The scene has an environment.
  Reflections(const SimulatedScene& scene, const WorldTriangles& triangles,
              const Lighting& lighting);

  // Light of one sample; the mean over a pixel's samples is what the pixel shows. Of rough surfaces
  // without lamps, whose highlights Lighting computes.
  double at(const ShadedPoint& surface, const Material& material, const LobeSample& lobe) const;

 private:
  // World frame; `direction`: unit.
  struct Ray {
    Eigen::Vector3d origin_m, direction;
    int eighth = 0;  // of the lights
  };
  // What comes from a ray's direction.
  double arriving(const Ray& ray, const Environment& environment, double solid_angle) const;
  double light_of_part(const SceneHit& hit, const Ray& ray) const;
  double light_of_plane(const Eigen::Vector3d& point_m, int eighth) const;

  const SimulatedScene& scene_;
  const WorldTriangles& triangles_;
  const Lighting& lighting_;
  SceneRays rays_;
  BoardPlane plane_;
};

}  // namespace edgescout
