// Finds the registered, scored candidates of one object in one image by a cascade of three stages.
//
//   stage   views     tensor   poses that enter                      registered by
//   coarse  one       reduced  scan hits, coarse_poses               refine.search.coarse
//   coarse  several   reduced  rescored hits, coarse_poses_joint     coarse_joint
//   medium  any       full     all aligned, medium_poses_joint       medium
//   fine    any       full     candidates                            refine
#pragma once

#include <vector>

#include "host/detect/detect_options.h"
#include "host/detect/detect_trace.h"
#include "host/detect/rescore_in_views.h"
#include "host/register/refine.h"

namespace edgescout {

// Of an estimate with features: they are pooled over its views.
Detection to_detection(const PoseEstimate& estimate);

// Whether a pose in the frame of this camera lies so near a known instance (thresholds::NEAR_KNOWN)
// that alignment would move it there.
PoseFilter near_known(std::span<const Se3> known_in_world, const TemplateSet& set,
                      const Se3& camera_from_world);

// The candidates of search.set in search.view with features, highest rank first, duplicates merged.
// Poses are in the view's camera frame; their object is 0.
//
// At most options.support_views of search.support are chosen (support_views.h). They take part in
// all stages: hits are rescored in them and poses are registered in them. Features hold search.view
// first, then the chosen views. `known_in_world` are instances that need not be found again: hits
// near them are not aligned, and poses that end within SAME_POSE of one are dropped. `trace`, where
// given, receives what every stage held.
std::vector<PoseEstimate> find_candidates(const ObjectSearch& search,
                                          std::span<const Se3> known_in_world,
                                          const DetectOptions& options,
                                          SearchTrace* trace = nullptr);

// The same from hits of any images that are in the camera frame of search.view, already rescored,
// and near no known instance (pooled_hits).
std::vector<PoseEstimate> find_candidates(const ObjectSearch& search,
                                          std::span<const ScanHit> rescored,
                                          std::span<const Se3> known_in_world,
                                          const DetectOptions& options);

}  // namespace edgescout
