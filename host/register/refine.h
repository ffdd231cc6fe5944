// A pose from a rough start: search around it, D2CO, polish, features. What detection does with its
// candidates and what `edgescout register` does with anybody's.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"
#include "host/register/edge_icp.h"
#include "host/register/pose_features.h"

namespace edgescout {

// Search: besides the start itself, starts turned by `rotation_rad` about the 6 axis directions and
// 8 cube diagonals of the camera frame are registered coarsely (few points, wide loss); of those
// and the start as it was given the ones with the highest log-odds (pose_features.h) go on.
struct SearchOptions {
  double rotation_rad = 0.3;  // 0: no search, the start alone; in [0, 1]
  int num_kept = 4;           // different poses that go on to the full registration
  D2coOptions coarse = coarse_defaults();
  static D2coOptions coarse_defaults();
};

struct RefineOptions {
  SearchOptions search;
  D2coOptions d2co = full_defaults();
  D2coRound unsearched{LOSS_GEMAN_MCCLURE, 30, 10,
                       300};  // goes before d2co's rounds where no search brought the start near
  bool use_edge_icp = true;
  EdgeIcpOptions edge_icp_options;
  PoseScoreOptions score{1.0f, 4.0f, 60.0f};
  int at_once = 256;  // pairs of a hypothesis and a view, with a search up to 2 MB of points each;
                      // results do not depend on it
  static D2coOptions full_defaults();
  void validate() const;
};

struct Refined {
  Registration registration;
  PoseFeatures features;              // over all views
  std::vector<PoseFeatures> by_view;  // in the order of the views
};

// Results in the order of the hypotheses.
std::vector<Refined> refine_poses(std::span<const EdgeModel> models,
                                  std::span<const ObjectPose> hypotheses,
                                  std::span<const RegisterView> views, Backend& backend,
                                  const RefineOptions& options);

}  // namespace edgescout
