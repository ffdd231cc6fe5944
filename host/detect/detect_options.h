// Options of detection in single images and over several.
//
// Public header.
#pragma once

#include "host/core/options.h"
#include "host/detect/edge_claims.h"
#include "host/detect/plausible_pairs.h"
#include "host/detect/rescore_in_views.h"
#include "host/register/refine.h"

namespace edgescout {

struct DetectOptions {
  // Objects that span fewer pixels are searched in the image enlarged twice; 0: none are
  // (host/enlarged_view.h). It helps some parts only: docs/research/detection.md.
  double enlarge_below_px = 0;
  ScanOptions scan;
  int support_views = 4;          // other images that support the search of one (support_views.h)
  int coarse_poses = 10000;       // distinct scan hits that enter the coarse stage
  int medium_poses = 1000;        // of these, by edge support, that enter the medium stage
  int coarse_poses_joint = 3000;  // the same where other images support the search
  int medium_poses_joint = 200;
  int candidates = 60;  // distinct poses that enter the fine stage (the paper's object candidates)
  D2coOptions coarse = schedules::coarse();
  D2coOptions medium = schedules::medium();
  RefineOptions refine = refine_defaults();  // the fine stage
  EdgeClaimOptions edge_claims;
  // How far parts may reach into each other, m. Where two poses found in several views reach
  // further, the less probable one loses probability (plausible_pairs.h).
  double penetration_m = DEFAULT_PENETRATION_M;
  double restart_rotation_rad = 0.3;  // of turned starts around the selected poses; 0: none
  double min_probability = 0.4;       // of a reported pose; docs/calibration.md has the reliability
  int max_detections = 100;
  static RefineOptions refine_defaults();
  void validate() const;  // InputError naming the field and the violated bound
};

// Names to `visit` every option of detection in single images but those of scan.world, edge_claims
// and refine, which have their own describe.
void describe(DetectOptions& options, OptionVisitor& visit);
// Names the parts of them that other verbs also have: the search, and of it the numbers of hits and
// poses.
void describe_search(DetectOptions& options, OptionVisitor& visit);
void describe_hits(DetectOptions& options, OptionVisitor& visit);

}  // namespace edgescout
