// Finds the registered, scored candidates of one object in one image by a cascade of three stages.
//
//   stage   tensor   poses that enter                                    registered by
//   coarse  reduced  hits of lowest rank, coarse_poses(_joint)           coarse
//   medium  full     those that edges support most, medium_poses(_joint) medium
//   fine    full     those of the highest rank, candidates               refine
//
// The coarse stage aligns templates' points, the others those that depth maps show to be visible.
#pragma once

#include <vector>

#include "host/detect/detect_options.h"
#include "host/detect/detect_trace.h"
#include "host/detect/rescore_in_views.h"
#include "host/detect/select_detections.h"
#include "host/register/refine.h"

namespace edgescout {

// Returns the test whether a pose in the frame of this camera lies so near a known instance
// (thresholds::NEAR_KNOWN) that alignment would move it there.
PoseFilter near_known(std::span<const Se3> known_in_world, const TemplateSet& set,
                      const Se3& camera_from_world);

// Returns the candidates of search.set in search.view with features, most probable first,
// duplicates merged. Poses are in the view's camera frame; their object is 0.
//
// At most options.support_views of search.support are chosen (support_views.h). They take part in
// all stages: hits are rescored in them and poses are registered in them. Features hold search.view
// first, then the chosen views. `known_in_world` are instances that need not be found again: hits
// near them are not aligned, and poses within SAME_POSE of one are no candidates. Poses that
// options.scan.world excludes are dropped between the stages; those within SAME_POSE of the prior
// remain, since registration over more images may move them there. `trace`, where given, receives
// what every stage held. `search.watch`, where given, laps "scan", "coarse", "medium" and "fine".
std::vector<PoseEstimate> find_candidates(const ObjectSearch& search,
                                          std::span<const Se3> known_in_world,
                                          const DetectOptions& options,
                                          SearchTrace* trace = nullptr);

// Returns the candidates that come from hits of any images that are in the camera frame of
// search.view, already rescored, and near no known instance (pooled_hits).
std::vector<PoseEstimate> find_candidates(const ObjectSearch& search,
                                          std::span<const ScanHit> rescored,
                                          std::span<const Se3> known_in_world,
                                          const DetectOptions& options);

}  // namespace edgescout
