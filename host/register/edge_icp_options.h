// Options of edge_icp (edge_icp.h).
//
// Public header.
#pragma once

#include <vector>

#include "host/model/visible_edges.h"

namespace edgescout {

struct EdgeIcpRound {
  float radius_px = 3;  // of association
  float scale_px = 1;   // of the loss
  int iterations = 4;
};

// Starts beside a pose. A few lines of the model often fit neighbouring edges of the image as well,
// and one view shows a tilt or the distance by a pixel or two.
struct BasinHops {
  double tilt_rad = 0.15;        // about axes across the line of sight
  double distance_share = 0.02;  // of the distance, nearer and farther
  std::vector<EdgeIcpRound> rounds{{.radius_px = 3, .scale_px = 1.5f, .iterations = 4},
                                   {.radius_px = 2, .scale_px = 0.8f, .iterations = 4}};
};

struct EdgeIcpOptions {
  std::vector<EdgeIcpRound> rounds{{.radius_px = 5, .scale_px = 2.5f, .iterations = 4},
                                   {.radius_px = 3, .scale_px = 1.2f, .iterations = 5},
                                   {.radius_px = 2, .scale_px = 0.8f, .iterations = 5}};
  float max_turn_rad = 0.3f;
  double min_matched = 0.1;  // of the visible points in all views: with fewer a pose stays as it is
  int max_points = 0;        // per view, evenly thinned; 0: all
  double min_step_m = 2e-6;  // a smaller step ends the round
  double min_step_rad = 2e-5;
  BasinHops hops;
  VisibilityOptions visibility;
  void validate() const;  // InputError naming the field and the violated bound
};

}  // namespace edgescout
