// Names the stage at which detection lost a pose that is known to be right.
//
// The given pose is looked for in a traced detection (detect_trace.h). The stage after the last one
// that held it lost it.
//
//   stage        holds the given pose if
//   range        its centre lies in the searched distances, viewpoints and region, and the prior in
//                the world admits it
//   edges        the image supports it more than copies of it beside it (kernels/edge_support.h)
//   scan         a hit that is aligned lies within a quarter of the object's size in the image
//   support      such a hit, aligned on the coarse tensor, enters the medium stage
//   alignment    a pose after the medium stage is the same
//   ranking      a candidate, which enters the fine stage, is the same
//   refinement   a pose after the fine stage is the same
//   probability  such a pose has DetectOptions::min_probability
//   selection    a reported pose is the same
//
//   DetectTrace trace;
//   detect_objects(view, sets, backend, options, &trace);
//   const LossReport report = explain_loss({models_of(sets), {&trace.view, 1}, backend}, sets[0],
//                                          trace, {0, camera_from_object}, options.detect);
//
// Public header.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "host/detect/detect_options.h"
#include "host/detect/detect_trace.h"
#include "host/detect/same_pose.h"
#include "host/model/template_set.h"
#include "host/register/scene.h"

namespace edgescout {

enum class LossStage {
  Range,
  Edges,
  Scan,
  Support,
  Alignment,
  Ranking,
  Refinement,
  Probability,
  Selection,
  Reported,  // the pose was not lost
};
std::string to_string(LossStage stage);  // "range", .. "reported"

// A pose that some stage held, beside the given one. The errors are zero for another object.
struct FoundPose : ObjectPose {
  PoseError error;  // modulo symmetry
  double mspd_px = 0;
  double probability = 0;
  PoseFeatures features;
};

struct RangeReport {
  double distance_m = 0;                          // from the camera to the object's centre
  double distance_min_m = 0, distance_max_m = 0;  // searched
  double viewpoint_angle_rad = 0;                 // from the nearest viewpoint of the templates
  bool in_distances = false;                      // of the templates
  bool in_viewpoints = false;                     // within half the distance between viewpoints
  bool in_region = false;                         // of the search, inside the image
  bool in_prior = false;                          // in the world (detect/world_prior.h)
  bool holds() const { return in_distances && in_viewpoints && in_region && in_prior; }
};

struct EdgesReport {
  double visible = 0;   // number of points that the pose shows, inside the image or not
  double in_image = 0;  // of these: inside the image
  EdgeSupport support;
  // Returns whether the image tells the pose from its surroundings.
  bool exceeds_copies() const { return support.support > support.best_displaced; }
};

struct ScanReport {
  std::size_t hits = 0, aligned = 0;  // of the scan; distinct ones that are aligned
  std::size_t aligned_near = 0;       // of these: near the given pose
  // Of the best hit near the given pose: its rank among distinct hits, from 1 (absent: there is no
  // hit near it), and its mean tensor value.
  std::optional<std::size_t> rank;
  double mean_px = 0;
  double own_mean_px = 0;  // what a hit at the given pose itself would have (scan_mean_px)
};

// The edge support of poses after the coarse stage, as PoseClassifier::rank (template_support.h).
struct SupportReport {
  std::size_t medium = 0;       // poses that enter the medium stage
  std::size_t medium_near = 0;  // of these: from hits near the given pose
  double best_near = 0;         // of all from hits near the given pose; 0 where there are none
  double last = 0;              // the least of those that enter the medium stage
  double own = 0;               // of the given pose itself
};

struct AlignmentReport {
  std::size_t same = 0;              // poses after the medium stage that are the same
  std::optional<FoundPose> nearest;  // of all poses after the medium stage
  // The hit near the given pose with the most edge support, after the medium stage.
  std::optional<FoundPose> best_hit_became;
};

// Log-odds are those of PoseClassifier::rank after the medium stage.
struct RankingReport {
  // Of the best pose that is the same, among distinct poses, from 1.
  std::optional<std::size_t> rank;
  std::size_t candidates = 0;
  bool is_candidate = false;
  double log_odds = 0;       // of the best pose that is the same
  double last_log_odds = 0;  // of the last candidate
  double own_log_odds = 0;   // of the given pose itself after the medium stage
};

struct RefinementReport {
  std::optional<FoundPose> same;     // the most probable pose after the fine stage that is the same
  std::optional<FoundPose> nearest;  // of all poses after the fine stage
  FoundPose own;                     // what the fine stage makes of the given pose itself
};

struct SelectionReport {
  bool competes = false;      // a pose that is the same has enough probability and is no duplicate
  bool above_chance = false;  // its psi; others are never selected
  double claimed = 0;         // fraction of its explained edges that other selected poses claim
  // Where it was selected, and is less probable than DetectOptions::min_probability only since it
  // shares its odds with so many alternatives.
  std::optional<double> shared_probability;
  std::size_t alternatives = 0;
  std::optional<FoundPose> selected;  // the most probable selected pose that is the same
  std::size_t rank = 0;               // its rank by probability among the selected poses, from 1
  bool is_reported = false;           // it is among the DetectOptions::max_detections best
};

// The pose that took the place of the given one:
//   alignment    what the best hit near it became
//   ranking      the candidate that claims most of its edges
//   refinement   the pose after the fine stage that is nearest to it
//   selection    the selected pose that claims most of its edges; of a duplicate the better pose
struct Rival : FoundPose {
  double claimed = 0;         // fraction of the edges that the lost pose explains
  bool is_restarted = false;  // refined from a turned start around a selected pose
};

struct LossReport {
  LossStage lost_at = LossStage::Reported;
  RangeReport range;
  EdgesReport edges;
  ScanReport scan;
  SupportReport support;
  AlignmentReport alignment;
  RankingReport ranking;
  RefinementReport refinement;
  SelectionReport selection;
  std::optional<Rival> rival;
};

// Follows `given`, in the camera frame, through a detection in one image (detect_objects) with
// these options, and returns the stage that lost it, with its numbers. `set` is that of the given
// object. scene.models are those of all sets, scene.views is trace.view alone.
//
// InputError: a pose that is not rigid, not in front of the camera, or of which the image shows no
// edge; options out of bounds. LogicError: an object that is not in the trace, a trace of several
// views or with known instances.
LossReport explain_loss(const Scene& scene, const TemplateSet& set, const DetectTrace& trace,
                        const ObjectPose& given, const DetectOptions& options,
                        const SamePoseOptions& same = {});

}  // namespace edgescout
