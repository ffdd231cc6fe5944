#include "host/active/scout_options.h"

namespace edgescout {

PipelineOptions ScoutOptions::scout_defaults() {
  PipelineOptions options;
  options.detect.coarse_poses = 4000;
  options.detect.medium_poses = 400;
  options.detect.candidates = 25;
  return options;
}

void describe(ModeDetectionOptions& o, OptionVisitor& visit) {
  visit.group("Detection");
  visit.number(
      {"min-probability", "Poses of a lower probability are not reported", OptionLevel::Basic},
      o.min_probability, 0.0, 1.0);
  describe(o.edge_claims, visit);
}

void describe_budget(ScoutOptions& o, OptionVisitor& visit) {
  visit.group("Budget");
  visit.number({"max-views", "Largest number of images", OptionLevel::Basic}, o.max_views, 1,
               1000000);
  visit.number({"min-entropy",
                "End when the entropy of the modes is below this and the last image gave no new "
                "candidate, nats. 0: never"},
               o.min_entropy_nats, 0.0, 1e6);
  visit.number({"min-information",
                "End when every view is expected to give less information about the candidates, "
                "after its motion cost, nats. 0: never"},
               o.min_information_nats, 0.0, 1e6);
  visit.number({"min-gained",
                "End when the last image gave less information and no new candidate, nats. 0: "
                "never"},
               o.min_gained_nats, 0.0, 1e6);
  visit.number({"max-seconds",
                "End after this computing time, s. It is checked between images, so an image that "
                "has begun is finished. 0: no limit",
                OptionLevel::Basic},
               o.max_seconds, 0.0, 1e9);
  visit.group("Next view");
  visit.number({"first-view", "Number of the view from which the first image is taken"},
               o.first_view, 0, 1000000);
}

void describe(ScoutOptions& o, OptionVisitor& visit) {
  describe(o.next_view, visit);
  describe(o.combinations, visit);
  describe(o.particles, visit);
  visit.group("Belief");
  visit.number({"max-candidates",
                "Largest number of candidates, of all objects in sum, that are kept from image to "
                "image"},
               o.max_candidates, 1, 10000);
  visit.number({"known-probability",
                "Reported instances of at least this probability count as known: later searches "
                "skip them, and points that they hide are left out of other poses' scores. Above "
                "1: no instance"},
               o.known_probability, 0.0, 2.0);
  visit.number({"max-searches",
                "Largest number of searches of one image. Another search follows while the last "
                "one made more instances known"},
               o.max_searches, 1, 100);
}

void describe_ablations(ScoutOptions& o, OptionVisitor& visit) {
  visit.group("Ablations");
  describe_ablations(o.next_view, visit);
  visit.off_flag({"combinations-by-psi",
                  "Sample combinations by psi, as in the paper's Algorithm 1, instead of by "
                  "probability"},
                 o.probable_combinations);
  describe_ablations(o.combinations, visit);
  visit.off_flag({"search-alone", "Search each image without the support of earlier images"},
                 o.detect_jointly);
  visit.off_flag({"first-image-only",
                  "Search images only until something is found, as in the paper, instead of every "
                  "image"},
                 o.detect_in_every_image);
}

void describe_scout(ScoutOptions& o, OptionVisitor& visit) {
  describe_budget(o, visit);
  describe_strategy(o.next_view, visit);
  describe(o, visit);
  describe(o.pipeline.edges, visit);
  describe(o.pipeline.tensor, visit);
  describe_search(o.pipeline.detect, visit);
  describe(o.pipeline.detect.scan.world, visit);
  describe(o.detections, visit);
}

void ScoutOptions::validate() const {
  combinations.validate();
  particles.validate();
  next_view.validate();
  ScoutOptions copy = *this;
  BoundsCheck in("scout");
  describe_budget(copy, in);
  describe(copy, in);
  // The paper's own formula does not count in nats.
  in.require("min-information", min_information_nats, 0, next_view.use_paper_formula ? 0 : 1e6);
  in.require("detections.min_probability", detections.min_probability, 0, 1);
  in.require("detections.support_probability", detections.support_probability, 0, 1);
  in.require("extrinsics.max_residual_px", extrinsics.max_residual_px, 0, 1e9);
  in.require("extrinsics.min_probability", extrinsics.min_probability, 0, 1);
  in.require("extrinsics.absent_probability", extrinsics.absent_probability, 0,
             extrinsics.min_probability);
  in.require("extrinsics.held_probability", extrinsics.held_probability, 0, 1);
  in.require("extrinsics.max_missing", extrinsics.max_missing, 0, 1e9);
  detections.edge_claims.validate();
  extrinsics.joint.validate();
  extrinsics.single.validate();
  pipeline.validate();
}

}  // namespace edgescout
