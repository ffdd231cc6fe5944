// How rough metal and gloss reflect: the microfacets of GGX, even or brushed.
#pragma once

#include "host/render/scene.h"

namespace edgescout {

// A point that is seen. Unit vectors in the world frame; the first two lie on the same side of the
// surface.
struct ShadedPoint {
  Eigen::Vector3d point_m, normal, to_viewer;
  Eigen::Vector3d grain = Eigen::Vector3d::UnitX();  // brushed metal is smooth along it
};

// A direction that a facet mirrors to the viewer.
struct FacetSample {
  Eigen::Vector3d direction;  // unit, world frame
  double weight = 0;          // of the light from there; 0: it comes from behind the surface
  double density = 0;         // of the samples about it, per steradian
};

class Microfacets {
 public:
  Microfacets(const ShadedPoint& surface, const Material& material);

  // Draws a direction; `u` and `v` are spread over the unit square. The mean of weight times light
  // is what the viewer sees.
  FacetSample sample(double u, double v) const;
  // Light towards the viewer from a direction, for irradiance 1 from there (1 makes white white).
  double highlight(const Eigen::Vector3d& to_light) const;

 private:
  Eigen::Vector3d visible_facet(double u, double v) const;
  double density(const Eigen::Vector3d& facet) const;
  double share_seen(const Eigen::Vector3d& from) const;
  double reflectance(double cosine) const;

  double at_normal_, alpha_x_, alpha_y_;
  Eigen::Matrix3d world_from_surface_;  // columns: along the grain, across it, the normal
  Eigen::Vector3d viewer_;              // in the surface's frame, as all vectors of private members
};

}  // namespace edgescout
