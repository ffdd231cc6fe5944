// What the stages of a detection in one image held, for the question where a pose was lost
// (explain.h). Detection fills it where a caller gives one.
//
// Public header.
#pragma once

#include <vector>

#include "host/detect/coarse_scan.h"
#include "host/register/pose_estimate.h"

namespace edgescout {

// The search for one object. Poses are in the camera frame of the searched image; their object
// is 0. In one image without known instances, entry i of `coarse` is what became of start i, entry
// i of `medium` what became of start medium_starts[i], and entry i of `fine` what became of
// candidate i.
struct SearchTrace {
  std::vector<ScanHit> hits;
  std::vector<ObjectPose> starts;          // distinct hits that enter the coarse stage, best first
  std::vector<PoseEstimate> coarse;        // poses after the coarse stage
  std::vector<std::size_t> medium_starts;  // indices of those that enter the medium stage
  std::vector<PoseEstimate> medium;        // poses after the medium stage, with features
  std::vector<PoseEstimate> candidates;    // distinct poses that enter the fine stage, best first
  std::vector<PoseEstimate> fine;          // poses after the fine stage, with features
};

// The selection among the candidates of all objects, in the world of the views.
struct SelectionTrace {
  // Poses that are probable enough to compete: candidates, and from `first_restarted` on poses
  // refined from turned starts around those selected first.
  std::vector<PoseEstimate> competing;
  std::size_t first_restarted = 0;
  std::vector<Detection> selected;  // most probable first; max_detections of them are reported
  // Selected as well, but less probable than DetectOptions::min_probability; some only because they
  // share their odds with their alternatives.
  std::vector<Detection> less_probable;
};

// Returns whether both are copies of one estimate.
bool is_copy(const ObjectPose& a, const ObjectPose& b);

// Returns the selected poses with their features. LogicError: a selected pose did not compete.
std::vector<PoseEstimate> selected_estimates(const SelectionTrace& selection);

struct DetectTrace {
  ObjectView view;   // as it was searched: perhaps enlarged, with tensors; its camera is the world
  Camera camera;     // of the prepared view: lengths in pixels are reported in its image
  WorldPrior world;  // as it was searched, for this camera frame
  std::vector<SearchTrace> searches;  // by object
  SelectionTrace selection;
};

}  // namespace edgescout
