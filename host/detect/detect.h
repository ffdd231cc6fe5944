// From an observation to registered, scored detections of one object.
#pragma once

#include <vector>

#include "host/detect/coarse_scan.h"
#include "host/detect/edge_claims.h"
#include "host/detect/plausible_pairs.h"
#include "host/detect/probability.h"
#include "host/detect/rescore_in_views.h"
#include "host/register/refine.h"

namespace edgescout {

struct DetectOptions {
  ScanOptions scan;
  int support_views = 4;  // of other images that help to search one (support_views.h)
  int coarse_poses =
      2500;  // different ones among the scan's hits that are aligned, roughly and cheaply
  // The same where other images helped to rank the hits (joint_scan.h): more roughly still, by
  // `coarse_joint`, and the `medium_poses_joint` ones that fit best then go on.
  int coarse_poses_joint = 3000;
  int medium_poses_joint = 200;
  D2coOptions coarse_joint = coarse_joint_defaults();
  // different ones among those that are registered in full (the paper's object candidates)
  int candidates = 60;
  D2coOptions medium = medium_defaults();  // on the full tensor after the coarse one, before
                                           // Psi can judge: it means nothing 3 px off
  RefineOptions refine = refine_defaults();
  EdgeClaimOptions edge_claims;
  // How far parts may reach into each other: of poses found in several views that reach further,
  // the less probable one is doubted (plausible_pairs.h).
  double penetration_m = DEFAULT_PENETRATION_M;
  double restart_rotation_rad = 0.3;  // turned starts around what was chosen (settle.h); 0: none
  double min_probability = 0.05;      // of what is reported; docs/evaluation.md has the reliability
  int max_detections = 100;
  static RefineOptions refine_defaults();
  static D2coOptions coarse_joint_defaults();
  static D2coOptions medium_defaults();
  void validate() const;
};

Detection to_detection(int object, const Registration& registration, const PoseFeatures& features);

// Whether a pose in the frame of this camera lies so near a known instance, within a fifth of the
// diameter, that the alignment would draw it there.
PoseFilter near_known(std::span<const Se3> known_in_world, const TemplateSet& set,
                      const Se3& camera_from_world);

// The registered candidates of one object in one view (world: its camera frame), highest log-odds
// first, duplicates merged.
std::vector<Refined> find_candidates(const TemplateSet& set, const Observation& observation,
                                     Backend& backend, const DetectOptions& options);

// The same with the help of other images of the same static scene: hits are judged by all of them
// (joint_scan.h), registered in all of them, and ranked by what all of them say
// (probability_over_views.h). Of many others some are taken (support_views.h). Refined::by_view has
// the given view first, then those that helped. `known` are the instances of the object that need
// not be found again, in the world of the views: hits that are drawn to them are not aligned (nor
// those of another part stacked so near on one), and what ends within a tenth is no candidate.
std::vector<Refined> find_candidates(const TemplateSet& set, const Observation& observation,
                                     std::span<const Observation> others,
                                     std::span<const Se3> known, Backend& backend,
                                     const DetectOptions& options);

// The same of hits in the observation's camera frame, whatever image they come from, that all
// images have judged already and of which none is drawn to a known instance (pooled_hits,
// joint_scan.h).
std::vector<Refined> find_candidates(const TemplateSet& set, std::span<const ScanHit> judged,
                                     const Observation& observation,
                                     std::span<const Observation> others,
                                     std::span<const Se3> known, Backend& backend,
                                     const DetectOptions& options);

}  // namespace edgescout
