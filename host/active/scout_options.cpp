#include "host/active/scout_options.h"

#include "host/core/option_bounds.h"

namespace edgescout {

PipelineOptions ScoutOptions::scout_defaults() {
  PipelineOptions options;
  options.detect.scan.num_kept = 40000;
  options.detect.coarse_poses = 600;
  options.detect.candidates = 25;
  return options;
}

void ScoutOptions::validate() const {
  const OptionBounds in("scout");
  in("max_candidates", max_candidates, 1, 10000);
  in("known_probability", known_probability, 0, 2);
  in("max_searches", max_searches, 1, 100);
  in("first_view", first_view, 0, 1e6);
  in("max_views", max_views, 1, 1e6);
  in("min_entropy_nats", min_entropy_nats, 0, 1e6);
  // The paper's own formula does not count in nats.
  in("min_information_nats", min_information_nats, 0, next_view.use_paper_formula ? 0 : 1e6);
  in("min_gained_nats", min_gained_nats, 0, 1e6);
  in("max_seconds", max_seconds, 0, 1e9);
  in("detections.min_probability", detections.min_probability, 0, 1);
  in("detections.support_probability", detections.support_probability, 0, 1);
  in("extrinsics.max_residual_px", extrinsics.max_residual_px, 0, 1e9);
  in("extrinsics.min_probability", extrinsics.min_probability, 0, 1);
  in("extrinsics.absent_probability", extrinsics.absent_probability, 0, extrinsics.min_probability);
  in("extrinsics.held_probability", extrinsics.held_probability, 0, 1);
  in("extrinsics.max_missing", extrinsics.max_missing, 0, 1e9);
  detections.edge_claims.validate();
  extrinsics.joint.validate();
  extrinsics.single.validate();
  pipeline.validate();
  combinations.validate();
  particles.validate();
  next_view.validate();
}

}  // namespace edgescout
