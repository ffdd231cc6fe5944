// From a rough start to a pose: search around it, D2CO, edge ICP, features.
//
// Detection does this with its candidates, `edgescout register` with given starts.
//
// Public header.
#pragma once

#include <span>
#include <vector>

#include "host/register/d2co.h"
#include "host/register/edge_icp.h"
#include "host/register/pose_features.h"
#include "host/register/schedules.h"

namespace edgescout {

// The search registers the start and 14 turned copies of it coarsely (few points, wide loss). The
// copies are turned by `rotation_rad` about the 6 axis directions and 8 cube diagonals of the
// camera frame. Of these poses and the start as it was given, those of the highest
// PoseClassifier::rank go on.
struct SearchOptions {
  double rotation_rad = 0.3;  // 0: no search, the start alone; in [0, 1]
  int num_kept = 4;           // different poses that go on to the full registration
  D2coOptions coarse = schedules::search();
};

struct RefineOptions {
  SearchOptions search;
  // The final rounds. d2co.solver chooses their implementation; the search has its own
  // (search.coarse.solver) and stays batched unless that is changed as well.
  D2coOptions d2co = schedules::fine();
  D2coRound unsearched =
      schedules::unsearched();  // precedes d2co's rounds where there is no search
  bool use_edge_icp = true;
  EdgeIcpOptions edge_icp;
  PoseScoreOptions score = FeatureOptions{}.score;
  // Pairs of a pose and a view that are processed at once. With a search a pair takes up to 2 MB of
  // points. Results do not depend on it.
  int batch_size = 256;
  // Not an aggregate: where a later member of a temporary throws, gcc 12 warns that `search` or
  // `edge_icp` may be uninitialised as they are destroyed (-Wmaybe-uninitialized).
  RefineOptions() = default;
  void validate() const;  // InputError naming the field and the violated bound
};

void describe(RefineOptions& options, OptionVisitor& visit);

// Lets the probable poses of one view hop to better optima beside them (hop_basins). Of estimates
// with features, after edge_icp; measures the features of those that move anew. Many starts end at
// one pose: one of them hops, the most probable one, and the others take its end.
//
// refine_poses does so in one view only: several show the tilt and the distance of a pose well
// enough.
void hop_probable(const Scene& scene, std::span<PoseEstimate> estimates,
                  const RefineOptions& options);

// Registers the starts and returns an estimate for each, in their order, with features. The first
// view's camera frame turns the starts of the search. InputError: options out of bounds;
// LogicError: no view.
std::vector<PoseEstimate> refine_poses(const Scene& scene, std::span<const ObjectPose> starts,
                                       const RefineOptions& options);

}  // namespace edgescout
