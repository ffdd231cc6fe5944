#include "host/cli/pipeline_options.h"

namespace edgescout {

void add_edge_and_tensor_options(CLI::App& verb, PipelineOptions& o, std::string& edge_method) {
  OptionTable(verb, "Edges")
      .choice("edges", edge_method, {"gradient", "lsd"}, "Edge detector")
      .bounded("edge-sigma", o.edges.gradient.sigma_px, 0.3f, 8.0f, "Blur before differentiation, px")
      .bounded("edge-low", o.edges.gradient.low_threshold, 0.1f, 127.0f,
               "Weaker pixels are no edge, grey levels a pixel")
      .bounded("edge-high", o.edges.gradient.high_threshold, 0.1f, 127.0f,
               "A chain needs one pixel of this strength")
      .bounded("edge-min-length", o.edges.gradient.min_length_px, 1, 10000, "Of a chain, px")
      .flag("faint-edges,!--no-faint-edges", o.edges.faint_edges,
            "Also long faint edges at a coarser scale (default)");
  OptionTable(verb, "Tensor")
      .bounded("bins", o.tensor.bins, 4, 128, "Orientations over pi; even")
      .bounded("lambda", o.tensor.lambda_px_per_rad, 0.0f, 10000.0f,
               "Weight of orientation against location, px/rad")
      .bounded("smoothing-variance", o.tensor.smoothing_variance, 0.0f, 16.0f, "Over orientation, bins^2")
      .bounded("cap", o.tensor.cap_px, 1.0f, 255.0f, "Largest distance, px");
}

void add_hit_options(CLI::App& verb, const std::string& group, DetectOptions& d) {
  OptionTable(verb, group)
      .bounded("scan-hits", d.scan.kept, 1, 10000000,
               "Of an image and type; other images of the scene judge all of them")
      .bounded("aligned", d.aligned, 1, 1000000, "Of these, aligned on the coarse tensor")
      .bounded("aligned-jointly", d.aligned_jointly, 1, 1000000,
               "The same where other images of the scene help")
      .bounded("promising", d.promising, 1, 1000000,
               "The best of those aligned jointly, aligned in full resolution");
}

void add_search_options(CLI::App& verb, DetectOptions& d) {
  OptionTable(verb, "Detection")
      .bounded("template-points", d.scan.points, 4, 256, "Of each template in the scan")
      .bounded("anchor-step", d.scan.anchor_step, 1, 16, "Between places of the scan, coarse px");
  add_hit_options(verb, "Detection", d);
  OptionTable(verb, "Detection")
      .bounded("helping-views", d.helping_views, 1, 10000,
               "Other images of the scene that help to search one")
      .bounded("candidates", d.candidates, 1, 100000, "Candidates registered in full");
}

void add_choice_options(CLI::App& verb, double& min_probability, EvidenceOptions& evidence) {
  OptionTable(verb, "Detection")
      .bounded("max-spent", evidence.max_spent, 0.0, 1.0,
               "Of a pose's edges: more explained by better poses, and it goes")
      .bounded("min-probability", min_probability, 0.0, 1.0, "Less probable poses are not reported");
}

void add_detection_options(CLI::App& verb, PipelineOptions& o) {
  DetectOptions& d = o.detect;
  add_search_options(verb, d);
  add_choice_options(verb, d.min_probability, d.evidence);
  OptionTable(verb, "Detection")
      .bounded("region-x", d.scan.within.x, 0.0, 1e6,
               "Left border of the part of every undistorted image where objects' centres are looked for, px")
      .bounded("region-y", d.scan.within.y, 0.0, 1e6, "Upper border, px")
      .bounded("region-width", d.scan.within.width, 0.0, 1e6, "px; 0: to the image's border")
      .bounded("region-height", d.scan.within.height, 0.0, 1e6, "px; 0: to the image's border")
      .bounded("second-look", d.second_look_rad, 0.0, 1.0,
               "Turned starts around what was chosen, rad; 0: none")
      .bounded("max-detections", d.max_detections, 1, 100000, "Reported an image")
      .bounded("penetration", d.penetration_m, 0.0, 1.0,
               "Of several images of one scene: how far parts may reach into each other, m");
}

void add_belief_options(CLI::App& verb, ScoutOptions& o) {
  OptionTable(verb, "Information")
      .bounded("map-reduction", o.next_view.reduction, 1.0, 16.0, "Image px a px of the distance maps")
      .bounded("chamfer-cap", o.next_view.cap_px, 0.1, 255.0, "Of distances, image px")
      .bounded("free-sight", o.next_view.free_sight, 0.0, 100.0,
               "How much lower cameras are hidden by what is unknown; 0: not at all")
      .bounded("repeat-angle", o.next_view.repeat_rad, 0.0, 100.0,
               "Within which views tell much the same, rad; 0: every view is new")
      .bounded("unknown", o.next_view.unknown_nats, 0.0, 1000.0,
               "Expected of a view about what is no candidate yet, nats")
      .bounded("unknown-angle", o.next_view.unknown_repeat_rad, 0.0, 100.0,
               "As --repeat-angle, of what is unknown")
      .bounded(
          "seen", o.next_view.seen_px, 0.0, 8.0,
          "A part's point was seen in an image whose edges lie so near, px; 0: wherever it lies in one, as "
          "in the paper")
      .flag("literal", o.next_view.literal, "The paper's own formula for the information")
      .bounded("combinations", o.combinations.count, 1, 1000000, "Scenes imagined for a decision")
      .bounded("sharpness", o.combinations.sharpness, 0.0, 500.0,
               "Of the preference for likely candidates in them, by psi; 1: the paper's")
      .flag("scenes-by-probability,!--scenes-by-psi", o.probable_combinations,
            "Imagine scenes as often as they are believed in (default), or as in the paper's Algorithm 1");
  OptionTable(verb, "Belief")
      .bounded("sigma", o.next_view.sigma_px, 0.001, 1000.0,
               "Of the mean distance of a right pose, image px, in weights and in the information; at least "
               "1/141 of --chamfer-cap")
      .bounded("penetration", o.particles.penetration_m, 0.0, 1.0,
               "How far parts may reach into each other, m: else no scene has both, and the less probable is "
               "doubted")
      .bounded("particles", o.particles.count, 1, 16384,
               "Poses that are followed; new candidates add to them until they are resampled")
      .bounded("max-candidates", o.max_candidates, 1, 10000,
               "Of all objects together, kept from image to image")
      .bounded("known-probability", o.known_probability, 0.0, 2.0,
               "Reported instances as probable as this are not sought again and hide what is behind them; "
               "above 1: none")
      .bounded("max-searches", o.max_searches, 1, 100,
               "Of one image: again while the last one made more instances known")
      .flag("jointly,!--alone", o.detect_jointly,
            "Detect in later images with the help of those before (default), or in each alone")
      .flag("every-image,!--first-image-only", o.detect_in_every_image,
            "Detect in every image (default), or until something is found, as in the paper");
}

void add_template_options(CLI::App& verb, TemplateOptions& o) {
  OptionTable(verb, "Templates")
      .bounded("distance-min", o.distance_min_m, 0.0, 1000.0,
               "Camera to object, m; 0: from its size and the camera")
      .bounded("distance-max", o.distance_max_m, 0.0, 1000.0, "m")
      .bounded("distance-ratio", o.distance_ratio, 1.001, 2.0, "Between neighbouring distances")
      .bounded("viewpoints", o.frequency, 1, 16, "Frequency f of the icosphere: 10 f^2 + 2 viewpoints")
      .bounded("in-plane-steps", o.in_plane_steps, 1, 360, "Rotations about the line of sight")
      .bounded("latitude-min", o.range.latitude_min_deg, -90.0, 90.0,
               "Of viewpoints over the object's x-y plane, degrees")
      .bounded("latitude-max", o.range.latitude_max_deg, -90.0, 90.0, "degrees")
      .bounded("longitude-min", o.range.longitude_min_deg, -360.0, 360.0, "degrees")
      .bounded("longitude-max", o.range.longitude_max_deg, -360.0, 720.0, "degrees")
      .bounded("crease-angle", o.edges.crease_angle_deg, 1.0, 179.0, "Sharper mesh edges are drawn, degrees")
      .bounded("raster-step", o.edges.raster_step_m, 0.0, 1.0, "Between edge points, m; 0: diameter / 80");
}

}  // namespace edgescout
