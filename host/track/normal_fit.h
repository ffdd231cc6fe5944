// Fits a pose to the edges that a search along normals found, and measures how well it fits.
#pragma once

#include "host/core/se3.h"
#include "host/track/normal_search.h"

namespace edgescout {

// How far a pose may be expected to lie from a given one: standard deviations of its tangent.
struct PosePrior {
  Se3 camera_from_object;
  double sigma_m = 0, sigma_rad = 0;
};

// Gauss-Newton over the distances of the projected points from their edges along the normals of the
// search, with Geman-McClure weights. Of several edges on a line the one counts that is near and
// has the expected contrast. The prior, in px like the distances, keeps the pose where edges do not
// determine it.
Se3 fit_to_edges(const NormalSearch& search, const Camera& ideal, const Se3& camera_from_object,
                 double scale_px, int iterations, const PosePrior& prior);

// The shift in the image that brings most points onto edges, within the reach of the search, as a
// motion of the object across the line of sight. For motions too large for fit_to_edges.
Se3 shifted_to_edges(const NormalSearch& search, const Camera& ideal,
                     const Se3& camera_from_object);

// How well the edges of a search at this pose fit it.
struct NormalFit {
  int points = 0;        // searched
  double matched = 0;    // share of them with an edge within 1.5 px
  double by_chance = 0;  // the share that copies displaced along the normals would have
  double explained = 0;  // sum of the Geman-McClure weights over the number of points
  Matrix6d covariance = Matrix6d::Zero();  // edge_covariance.h; tangent of core/se3.h
  // (matched - by_chance) / (1 - by_chance): 1 for a pose on its edges, about 0 for a random one.
  double above_chance() const;
};
NormalFit measure_fit(const NormalSearch& search, const Camera& ideal,
                      const Se3& camera_from_object);

}  // namespace edgescout
