#include "host/cli/pipeline_options.h"

namespace edgescout {

void add_edge_and_tensor_options(CLI::App& verb, PipelineOptions& o, std::string& edge_method) {
  OptionTable(verb, "Edges")
      .choice("edges", edge_method, {"gradient", "lsd"}, "Edge detector")
      .bounded("edge-sigma", o.edges.gradient.sigma_px, 0.3f, 8.0f,
               "Blur of the image before it is differentiated, standard deviation, px")
      .bounded("edge-low", o.edges.gradient.low_threshold, 0.1f, 127.0f,
               "Pixels of a weaker gradient are no edge, grey levels a pixel")
      .bounded("edge-high", o.edges.gradient.high_threshold, 0.1f, 127.0f,
               "A chain of edge pixels needs one of at least this gradient, grey levels a pixel")
      .bounded("edge-min-length", o.edges.gradient.min_length_px, 1, 10000,
               "Shortest chain of edge pixels that is kept, px")
      .flag("faint-edges,!--no-faint-edges", o.edges.faint_edges,
            "Find long faint edges too, at a coarser scale (default)");
  OptionTable(verb, "Tensor")
      .bounded("bins", o.tensor.bins, 4, 128,
               "Orientations that edges are sorted into, over half a turn; even")
      .bounded("lambda", o.tensor.lambda_px_per_rad, 0.0f, 10000.0f,
               "Weight of an orientation's error against a distance, px/rad");
  add_tensor_value_options(verb, "Tensor", o.tensor);
}

void add_tensor_value_options(CLI::App& verb, const std::string& group, TensorOptions& t) {
  OptionTable(verb, group)
      .bounded("smoothing-variance", t.smoothing_variance, 0.0f, 16.0f,
               "Variance of the smoothing over orientation, bins^2")
      .bounded("cap", t.cap_px, 1.0f, 255.0f, "Largest distance to an edge that counts, px");
}

void add_hit_options(CLI::App& verb, const std::string& group, DetectOptions& d) {
  OptionTable(verb, group)
      .bounded("scan-hits", d.scan.num_kept, 1, 10000000,
               "Best hits of the scan that are kept, an image and object; other images of the "
               "scene judge "
               "all of them")
      .bounded("coarse-poses", d.coarse_poses, 1, 1000000,
               "Best hits of the scan that are aligned, on the coarse tensor")
      .bounded("coarse-poses-joint", d.coarse_poses_joint, 1, 1000000,
               "Best hits of the scan that are aligned where other images of the scene help, in "
               "place of "
               "--coarse-poses")
      .bounded("medium_poses_joint", d.medium_poses_joint, 1, 1000000,
               "Best of the hits of --coarse-poses-joint, which are aligned in full resolution");
}

void add_search_options(CLI::App& verb, DetectOptions& d) {
  OptionTable(verb, "Detection")
      .bounded("template-points", d.scan.points, 4, 256,
               "Edge points of each template that the scan compares")
      .bounded("anchor-step", d.scan.anchor_step, 1, 16,
               "Distance between the places where the scan looks, px of the coarse tensor");
  add_hit_options(verb, "Detection", d);
  OptionTable(verb, "Detection")
      .bounded("support-views", d.support_views, 1, 10000,
               "Other images of the scene that help to search one")
      .bounded("candidates", d.candidates, 1, 100000,
               "Poses of each object that are registered in full, an image");
}

void add_choice_options(CLI::App& verb, double& min_probability, EdgeClaimOptions& edge_claims) {
  OptionTable(verb, "Detection")
      .bounded("max-claimed", edge_claims.max_claimed, 0.0, 1.0,
               "A pose goes where better poses explain more than this fraction of its edges")
      .bounded("min-probability", min_probability, 0.0, 1.0,
               "Less probable poses are not reported");
}

void add_detection_options(CLI::App& verb, PipelineOptions& o) {
  DetectOptions& d = o.detect;
  add_search_options(verb, d);
  add_choice_options(verb, d.min_probability, d.edge_claims);
  OptionTable(verb, "Detection")
      .bounded("region-x", d.scan.within.x, 0.0, 1e6,
               "Left border of the part of every undistorted image where objects' centres are "
               "looked for, px")
      .bounded("region-y", d.scan.within.y, 0.0, 1e6,
               "Upper border of the part of every undistorted image where objects' centres are "
               "looked for, px")
      .bounded("region-width", d.scan.within.width, 0.0, 1e6,
               "Width of the part of every undistorted image where objects' centres are looked "
               "for, px; 0: "
               "to the image's border")
      .bounded("region-height", d.scan.within.height, 0.0, 1e6,
               "Height of the part of every undistorted image where objects' centres are looked "
               "for, px; 0: "
               "to the image's border")
      .bounded("restart-rotation", d.restart_rotation_rad, 0.0, 1.0,
               "Angle by which starts around the chosen poses are turned, rad; 0: no second look")
      .bounded("max-detections", d.max_detections, 1, 100000,
               "Largest number of poses reported for an image")
      .bounded("penetration", d.penetration_m, 0.0, 1.0,
               "How far parts may reach into each other, m; of poses from several images of a "
               "scene that "
               "reach further the less probable is doubted");
}

namespace {

void add_information_options(CLI::App& verb, ScoutOptions& o) {
  OptionTable(verb, "Information")
      .bounded("map-reduction", o.next_view.reduction, 1.0, 16.0,
               "Image px that one px of the distance maps covers, along each axis")
      .bounded("chamfer-cap", o.next_view.cap_px, 0.1, 255.0,
               "Largest distance in the distance maps, image px")
      .bounded("free-sight", o.next_view.visibility_exponent, 0.0, 100.0,
               "How much lower cameras are hidden by what is unknown; 0: not at all")
      .bounded("repeat-angle", o.next_view.view_correlation_angle_rad, 0.0, 100.0,
               "Angle within which two views tell much the same of a candidate, rad; 0: every view "
               "is new")
      .bounded("unknown", o.next_view.exploration_bonus_nats, 0.0, 1000.0,
               "Information expected of a view about what is no candidate yet, nats")
      .bounded("unknown-angle", o.next_view.exploration_correlation_angle_rad, 0.0, 100.0,
               "Angle within which two views tell much the same of what is no candidate yet, rad; "
               "0: every "
               "view is new")
      .bounded("seen", o.next_view.seen_px, 0.0, 8.0,
               "A part's point counts as seen in an image with an edge this near, px; 0: wherever "
               "it lies in "
               "an image, as in the paper")
      .flag("use_paper_formula", o.next_view.use_paper_formula,
            "Expect the information by the paper's own formula")
      .bounded("combinations", o.combinations.count, 1, 1000000,
               "Scenes imagined for a decision on the next view")
      .bounded("sharpness", o.combinations.sharpness, 0.0, 500.0,
               "How much imagined scenes prefer candidates of high psi, with --scenes-by-psi; 1: "
               "the paper's")
      .flag("scenes-by-probability,!--scenes-by-psi", o.probable_combinations,
            "Imagine scenes as often as they are believed in (default), or as in the paper's "
            "Algorithm 1");
}

}  // namespace

void add_belief_options(CLI::App& verb, ScoutOptions& o) {
  add_information_options(verb, o);
  OptionTable(verb, "Belief")
      .bounded("sigma", o.next_view.sigma_px, 0.001, 1000.0,
               "Standard deviation of the mean distance of a right pose, image px, in weights and "
               "in the "
               "information; at least 1/141 of --chamfer-cap")
      .bounded("penetration", o.particles.penetration_m, 0.0, 1.0,
               "How far parts may reach into each other, m: else no scene has both, and the less "
               "probable is "
               "doubted")
      .bounded("particles", o.particles.count, 1, 16384,
               "Poses that the belief follows; new candidates add to them until they are resampled")
      .bounded("max-candidates", o.max_candidates, 1, 10000,
               "Candidates of all objects together that are kept from image to image")
      .bounded("known-probability", o.known_probability, 0.0, 2.0,
               "Reported instances at least this probable are not sought again and hide what is "
               "behind them; "
               "above 1: none do")
      .bounded("max-searches", o.max_searches, 1, 100,
               "Searches of one image at most: another follows while the last one made more "
               "instances known")
      .flag("jointly,!--alone", o.detect_jointly,
            "Detect in later images with the help of those before (default), or in each alone")
      .flag("every-image,!--first-image-only", o.detect_in_every_image,
            "Detect in every image (default), or until something is found, as in the paper");
}

void add_template_options(CLI::App& verb, TemplateOptions& o) {
  OptionTable(verb, "Templates")
      .bounded("distance-min", o.distance_min_m, 0.0, 1000.0,
               "Smallest distance from the camera to an object's centre, m; 0, with --distance-max "
               "0: by the "
               "object's size and the camera, in scout by what the views see")
      .bounded("distance-max", o.distance_max_m, 0.0, 1000.0,
               "Largest distance from the camera to an object's centre, m; 0, with --distance-min "
               "0: by the "
               "object's size and the camera, in scout by what the views see")
      .bounded("distance-ratio", o.distance_ratio, 1.001, 2.0,
               "Ratio of neighbouring distances that templates are made for")
      .bounded("viewpoints", o.frequency, 1, 16,
               "Frequency f of the icosphere of viewpoints on an object: 10 f^2 + 2 of them")
      .bounded("in-plane-steps", o.in_plane_steps, 1, 360,
               "Rotations of each template about the line of sight")
      .bounded("latitude-min", o.range.latitude_min_deg, -90.0, 90.0,
               "Lowest latitude of viewpoints over the object's x-y plane, degrees")
      .bounded("latitude-max", o.range.latitude_max_deg, -90.0, 90.0,
               "Highest latitude of viewpoints over the object's x-y plane, degrees")
      .bounded("longitude-min", o.range.longitude_min_deg, -360.0, 360.0,
               "First longitude of viewpoints about the object's z axis, degrees")
      .bounded("longitude-max", o.range.longitude_max_deg, -360.0, 720.0,
               "Last longitude of viewpoints about the object's z axis, degrees")
      .bounded("crease-angle", o.edges.crease_angle_deg, 1.0, 179.0,
               "Mesh edges are drawn where the normals of their faces differ by more, degrees")
      .bounded("raster-step", o.edges.raster_step_m, 0.0, 1.0,
               "Distance between the points of drawn edges, m; 0: diameter / 80");
}

}  // namespace edgescout
