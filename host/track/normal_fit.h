// Fits a pose to the edges that a search along normals found, and to the measured surface where
// there is one; measures how well it fits.
#pragma once

#include "host/core/se3.h"
#include "host/register/pose_estimate.h"
#include "host/track/normal_search.h"
#include "host/track/surface_fit.h"

namespace edgescout {

// How far a pose may be expected to lie from a given one: standard deviations of its tangent.
struct PosePrior {
  Se3 camera_from_object;
  double sigma_m = 0, sigma_rad = 0;
};

struct FitRound {
  double scale_px = 0;  // of the loss of edges
  int iterations = 0;
  double depth_sigmas = 0;  // scale of the loss of the measured surface
};

// Gauss-Newton over the distances of the projected points from their edges along the normals of the
// search, with Geman-McClure weights. Of several edges on a line the one counts that is near and
// has the expected contrast. The prior, in px like the distances, keeps the pose where edges do not
// determine it. `surface`, where not null, adds its distances from the measured one.
Se3 fit_to_edges(const NormalSearch& search, const Camera& ideal, const Se3& camera_from_object,
                 const FitRound& round, const PosePrior& prior,
                 const SurfaceFit* surface = nullptr);

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
  // edge_covariance.h, with the measured surface; tangent of core/se3.h.
  Matrix6d covariance = Matrix6d::Zero();
  DepthEvidence depth;  // all 0 where nothing was measured
  // (matched - by_chance) / (1 - by_chance): 1 for a pose on its edges, about 0 for a random one.
  double above_chance() const;
};
NormalFit measure_fit(const NormalSearch& search, const Camera& ideal,
                      const Se3& camera_from_object, const SurfaceFit* surface = nullptr);

}  // namespace edgescout
