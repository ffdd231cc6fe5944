// From an observation to registered, scored detections of one object.
#pragma once

#include <vector>

#include "host/detect/coarse_scan.h"
#include "host/detect/evidence.h"
#include "host/detect/probability.h"
#include "host/register/refine.h"

namespace edgescout {

struct DetectOptions {
  ScanOptions scan;
  int rescored = 3000;      // scan hits looked at with all their points
  int aligned = 500;        // different ones among them that are aligned on the coarse tensor
  int candidates = 60;      // different ones among those that are registered in full (the paper's object candidates)
  RefineOptions refine = refine_defaults();
  EvidenceOptions evidence;
  double joint_search_rad = 0;  // turned starts around every candidate when several views are joined; 0: none
  double min_probability = 0.5;
  int max_detections = 100;
  static RefineOptions refine_defaults();
  void validate() const;
};

// A registered candidate of one view, before anything is decided.
struct Scored {
  Se3 camera_from_object;
  Registration registration;
  PoseFeatures features;
  double probability = 0;
};

Detection to_detection(int object, const Registration& registration, const PoseFeatures& features);

// The registered candidates of one object in one view, best probability first, duplicates merged.
std::vector<Scored> find_candidates(const TemplateSet& set, const Observation& observation, Backend& backend, const DetectOptions& options);

// Keeps of all objects' candidates those that are probable enough and explain edges of the image that no better one explains (evidence.h).
std::vector<Detection> choose_detections(std::span<const EdgeModel> models, std::span<const std::vector<Scored>> candidates,
                                         const Observation& observation, Backend& backend, const DetectOptions& options);

}  // namespace edgescout
