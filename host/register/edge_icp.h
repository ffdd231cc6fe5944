// The last tenths of a pixel: re-association of model points to sub-pixel edge points.
//
// The tensor's seeds are whole pixels, and its orientation term pulls wherever an edge's direction
// is noisy. Near the optimum it is more exact to let every visible model point find its edge point
// anew and to minimise the distances to the edges' tangents by Gauss-Newton with Geman-McClure
// weights (the re-association that makes a hybrid of D2CO and ICP pay near the end).
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

struct EdgeIcpRound {
  float radius_px = 3;  // of association
  float scale_px = 1;   // of the loss
  int iterations = 4;
};

struct EdgeIcpOptions {
  std::vector<EdgeIcpRound> rounds{{5, 2.5f, 4}, {3, 1.2f, 5}, {2, 0.8f, 5}};
  float max_turn_rad = 0.3f;
  double min_matched =
      0.1;             // of the visible points in all views: with fewer the pose is left alone
  int max_points = 0;  // per view, evenly thinned; 0: all
  double min_step_m = 2e-6;  // a smaller step ends the round
  double min_step_rad = 2e-5;
  VisibilityOptions visibility;
  void validate() const;  // throws InputError naming the field and the violated bound
};

// Improves the pose of every registration in place and gives it the covariance of
// edge_covariance.h. Views without an edge index do not take part. Where there are too few edges
// all stays as it is.
void edge_icp(std::span<const EdgeModel> models, std::span<const ObjectPose> hypotheses,
              std::span<const RegisterView> views, Backend& backend, const EdgeIcpOptions& options,
              std::span<Registration> registrations);

}  // namespace edgescout
