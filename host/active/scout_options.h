// Options of an active detection (scout.h).
//
// Public header.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/active/combinations.h"
#include "host/active/extrinsics_check.h"
#include "host/active/modes.h"
#include "host/active/next_view.h"
#include "host/pipeline.h"

namespace edgescout {

struct ScoutOptions {
  PipelineOptions pipeline = scout_defaults();
  int max_candidates = 40;  // kept, of all objects in sum (the paper's N_obj)
  // false: images are searched until there are candidates, so in the first one alone, as in the
  // paper.
  bool detect_in_every_image = true;
  // The user's own detector, in place of candidates_in_images (candidates.h). It returns possible
  // instances in the images of these views, in the world. The last image is the new one; the others
  // are earlier ones, as far as detection may use them. `known` are instances that need not be
  // found again. Scout::give throws InputError for an object that does not exist and for a pose
  // that is not rigid.
  std::function<std::vector<Detection>(std::span<const int> views,
                                       std::span<const ObjectView> images,
                                       std::span<const ObjectPose> known)>
      detect;
  // A later image is searched with the earlier ones as support (detect/rescore_in_views.h). false:
  // each image alone.
  bool detect_jointly = true;
  // Reported instances (detections.min_probability) of at least this probability are treated as
  // known. Later searches skip them, and they act as occluders (register/occluders.h): points that
  // they hide are left out of every other pose's score, which then rests on fewer edges. A value
  // above 1 disables this.
  double known_probability = 0.9;
  // Of one image. While a search makes more instances known, the image is searched again for
  // objects behind and next to them; the hits on known instances then leave room for others. Only
  // with detect_in_every_image. 1: as in the paper.
  int max_searches = 2;
  // The seed is that of the first decision. The decision after n images adds n.
  CombinationOptions combinations;
  // Combinations are sampled by the candidates' probabilities. false: by psi (Algorithm 1).
  bool probable_combinations = true;
  // Its penetration_m also holds for candidates: one measure of which poses exclude each other.
  ParticleOptions particles;
  // Its sigma_px also holds for particles: one model of how far right poses lie off.
  NextViewOptions next_view;
  ModeDetectionOptions detections;
  ExtrinsicsCheckOptions extrinsics;
  int first_view = 0;  // for every strategy; with a fixed sequence, set this to its first view

  // The end, whichever comes first. A limit of 0 is none, except for max_views.
  int max_views = 5;  // images
  // Certain: entropy of the modes below this, and no new candidates in the last image.
  double min_entropy_nats = 0.01;
  // Little to learn: every view is expected to give less about the candidates, after its motion
  // cost (Strategy::Information).
  double min_information_nats = 0;
  // Little learned: the last image gave less, and no new candidates.
  double min_gained_nats = 0;
  // Of computing. It is checked between images, so one image may exceed it.
  double max_seconds = 0;
  // Called between stages and many times during detection, on the calling thread; true cancels. The
  // longest part without a call is a decision: half a second, on a software
  // device several.
  std::function<bool()> cancelled;

  // More hits per image than the detection in a single image keeps, because later images rescore
  // them. Fewer of them are aligned and registered: the next image shows what one image misses, in
  // half the time (docs/research/next_view.md).
  static PipelineOptions scout_defaults();
  void validate() const;  // InputError naming the field and the violated bound
};

// When the scout ends, and its first view.
void describe_budget(ScoutOptions& options, OptionVisitor& visit);
// The expected information and the belief.
void describe(ScoutOptions& options, OptionVisitor& visit);
// Every option of a scout, the one list for command line, bindings and bridges: these, the strategy
// and those of the pipeline and the detections.
void describe_scout(ScoutOptions& options, OptionVisitor& visit);
// Variants that the experiments compare with the defaults, of all parts.
void describe_ablations(ScoutOptions& options, OptionVisitor& visit);

}  // namespace edgescout
