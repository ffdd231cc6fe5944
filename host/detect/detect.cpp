#include "host/detect/detect.h"

#include "host/core/option_bounds.h"
#include "host/detect/probability_over_views.h"
#include "host/detect/support_views.h"
#include "host/detect/suppression.h"
#include "host/detect/template_points.h"

namespace edgescout {

namespace {

// Of the object's diameter: poses closer than that are the same, and a hit so near to a known
// instance is drawn to it by the alignment.
constexpr double SAME_POSE = 0.1, NEAR_KNOWN = 0.2;

// Of a template, before known objects hide some of them.
constexpr int COARSE_JOINT_POINTS = 120;

// Of one object, in metres and modulo its symmetry; `key` of an index is lower for better ones.
std::vector<std::size_t> best_of(std::span<const Se3> poses, const TemplateSet& set,
                                 std::size_t most, const auto& key) {
  std::vector<double> keys;
  for (std::size_t i = 0; i < poses.size(); ++i) keys.push_back(key(i));
  return best_distinct(poses, keys, set.model.mesh, set.symmetries,
                       SAME_POSE * set.model.mesh.diameter_m, most);
}

std::vector<ObjectPose> hypotheses_at(std::span<const Se3> poses,
                                      std::span<const std::size_t> chosen) {
  std::vector<ObjectPose> out;
  for (std::size_t i : chosen) out.push_back({0, poses[i]});
  return out;
}

std::vector<Se3> poses_of(std::span<const ObjectPose> hypotheses) {
  std::vector<Se3> poses;
  for (const ObjectPose& h : hypotheses) poses.push_back(h.world_from_object);
  return poses;
}

KnownPoses in_camera(std::span<const Se3> known_in_world, const TemplateSet& set,
                     const Se3& camera_from_world) {
  std::vector<Se3> poses;
  for (const Se3& pose : known_in_world) poses.push_back(camera_from_world * pose);
  return {poses, set.model.mesh, set.symmetries};
}

// The image's camera frame is the world.
std::vector<RegisterView> views_around(const Observation& observation,
                                       std::span<const Observation> others) {
  std::vector<RegisterView> views = views_of(others);
  views.insert(views.begin(), observation.view);
  const Se3 world_from_first = inverse(observation.view.camera_from_world);
  for (RegisterView& view : views)
    view.camera_from_world = view.camera_from_world * world_from_first;
  views[0].camera_from_world = Se3{};
  return views;
}

// What a pose that several views were aligned in costs where it lies. Few points, of what hardly
// shows, can be fitted to anything.
double cost_of(const Registration& registration) {
  constexpr int least_points = 12;
  return registration.points >= least_points ? registration.cost_px2 / registration.points
                                             : INFINITY;
}

std::vector<RegisterView> coarse_of(std::vector<RegisterView> views) {
  for (RegisterView& view : views) view.view = view.coarse;
  return views;
}

// Those of the hits that are worth a look in full resolution, aligned on the coarse tensors.
std::vector<ObjectPose> coarse_aligned(const TemplateSet& set, std::span<const ScanHit> hits,
                                       std::span<const RegisterView> coarse, Backend& backend,
                                       const DetectOptions& options) {
  const bool jointly = coarse.size() > 1;
  std::vector<Se3> poses;
  for (const ScanHit& hit : hits) poses.push_back(hit.camera_from_object);
  const std::vector<ObjectPose> starts = hypotheses_at(
      poses,
      best_of(poses, set, std::size_t(jointly ? options.coarse_poses_joint : options.coarse_poses),
              [&](std::size_t i) { return hits[i].rank; }));
  if (!jointly)
    return object_poses_of(starts, register_poses({&set.model, 1}, starts, coarse, backend,
                                                  options.refine.search.coarse));
  const std::vector<Registration> registrations =
      register_points(starts, coarse, template_points(set, coarse, COARSE_JOINT_POINTS, backend),
                      backend, options.coarse_joint);
  poses = poses_of(object_poses_of(starts, registrations));
  return hypotheses_at(poses, best_of(poses, set, std::size_t(options.medium_poses_joint),
                                      [&](std::size_t i) { return cost_of(registrations[i]); }));
}

}  // namespace

D2coOptions DetectOptions::coarse_joint_defaults() {
  D2coOptions options;
  // By a cost this sharp they are told apart: what is hidden costs no more than what is a little
  // off.
  options.rounds = {{LOSS_GEMAN_MCCLURE, 10, 8, 60}, {LOSS_GEMAN_MCCLURE, 1, 4, 60}};
  return options;
}

D2coOptions DetectOptions::medium_defaults() {
  D2coOptions options;
  options.rounds = {{LOSS_GEMAN_MCCLURE, 12, 6, 150}, {LOSS_GEMAN_MCCLURE, 5, 6, 200}};
  options.visibility.depth_map_size_px = 96;
  return options;
}

RefineOptions DetectOptions::refine_defaults() {
  RefineOptions options;
  options.search.rotation_rad = 0.25;  // templates stand some 0.2 rad apart
  return options;
}

void DetectOptions::validate() const {
  const OptionBounds in("detect");
  in("template_points", scan.points, 4, TEMPLATE_SCORE_MAX_POINTS);
  in("anchor_step", scan.anchor_step, 1, 16);
  in("region_columns", scan.region_columns, 1, 4096);
  in("region_rows", scan.region_rows, 1, 4096);
  in("region_columns * region_rows", double(scan.region_columns) * scan.region_rows, 1,
     TEMPLATE_SCORE_MAX_ANCHORS);
  in("region_x", scan.within.x, 0, 1e6);
  in("region_y", scan.within.y, 0, 1e6);
  in("region_width", scan.within.width, 0, 1e6);
  in("region_height", scan.within.height, 0, 1e6);
  in("scan_hits", scan.num_kept, 1, 1e7);
  in("coarse_poses", coarse_poses, 1, 1e6);
  in("coarse_poses_joint", coarse_poses_joint, 1, 1e6);
  in("medium_poses_joint", medium_poses_joint, 1, 1e6);
  in("support_views", support_views, 1, 1e4);
  in("candidates", candidates, 1, 1e5);
  in("min_probability", min_probability, 0, 1);
  in("restart_rotation", restart_rotation_rad, 0, 1);
  in("max_detections", max_detections, 1, 1e5);
  in("penetration", penetration_m, 0, 1);
  coarse_joint.validate();
  medium.validate();
  refine.validate();
  edge_claims.validate();
}

Detection to_detection(int object, const Registration& registration, const PoseFeatures& features) {
  Detection d;
  d.object = object;
  d.world_from_object = registration.world_from_object;
  d.covariance = registration.covariance;
  d.probability = pose_probability(features);
  d.psi = features.psi;
  d.cost_px = features.mean_px;
  d.matched_fraction = features.matched;
  d.psi_z_score = psi_z_score(features);
  d.unexplained_grey = unexplained_grey(features.shading);
  d.convergence = to_string(registration.reason);
  return d;
}

PoseFilter near_known(std::span<const Se3> known_in_world, const TemplateSet& set,
                      const Se3& camera_from_world) {
  return [known = in_camera(known_in_world, set, camera_from_world),
          radius_m = NEAR_KNOWN * set.model.mesh.diameter_m](const Se3& camera_from_object) {
    return known.any_within(radius_m, camera_from_object);
  };
}

std::vector<Refined> find_candidates(const TemplateSet& set, const Observation& observation,
                                     Backend& backend, const DetectOptions& options) {
  return find_candidates(set, observation, {}, {}, backend, options);
}

std::vector<Refined> find_candidates(const TemplateSet& set, const Observation& observation,
                                     std::span<const Observation> others,
                                     std::span<const Se3> known, Backend& backend,
                                     const DetectOptions& options) {
  const std::vector<Observation> helping =
      support_views(observation, others, std::size_t(options.support_views));
  std::vector<ScanHit> hits =
      rescore_in_views(set, coarse_scan(set, observation, backend, options.scan), observation,
                       helping, backend, options.scan);
  std::erase_if(hits, [excluded = near_known(known, set, observation.view.camera_from_world)](
                          const ScanHit& hit) { return excluded(hit.camera_from_object); });
  return find_candidates(set, hits, observation, others, known, backend, options);
}

std::vector<Refined> find_candidates(const TemplateSet& set, std::span<const ScanHit> hits,
                                     const Observation& observation,
                                     std::span<const Observation> all_others,
                                     std::span<const Se3> known, Backend& backend,
                                     const DetectOptions& options) {
  const std::vector<Observation> others =
      support_views(observation, all_others, std::size_t(options.support_views));
  const std::span<const EdgeModel> models(&set.model, 1);
  const std::vector<RegisterView> full = views_around(observation, others);
  const KnownPoses known_here = in_camera(known, set, observation.view.camera_from_world);
  const auto is_known = [&](const Se3& pose) {
    return known_here.any_within(SAME_POSE * set.model.mesh.diameter_m, pose);
  };
  std::vector<ObjectPose> hypotheses = coarse_aligned(set, hits, coarse_of(full), backend, options);
  hypotheses = object_poses_of(hypotheses,
                               register_poses(models, hypotheses, full, backend, options.medium));
  std::erase_if(hypotheses, [&](const ObjectPose& h) { return is_known(h.world_from_object); });
  const std::vector<Se3> poses = poses_of(hypotheses);
  const std::vector<PoseFeatures> features = pose_features_by_view(
      models, hypotheses, full, backend, options.refine.score, options.medium.visibility);
  const auto of_pose = [&](std::size_t i) {
    return std::span(features).subspan(i * full.size(), full.size());
  };
  const std::vector<std::size_t> chosen =
      best_of(poses, set, std::size_t(options.candidates),
              [&](std::size_t i) { return -merit(of_pose(i)); });

  RefineOptions refine = options.refine;
  if (!others.empty())
    refine.search.rotation_rad = 0;  // several views leave no doubt that a search could settle
  std::vector<Refined> refined =
      refine_poses(models, hypotheses_at(poses, chosen), full, backend, refine);
  std::erase_if(refined,
                [&](const Refined& r) { return is_known(r.registration.world_from_object); });
  std::vector<Se3> final_poses;
  for (const Refined& r : refined) final_poses.push_back(r.registration.world_from_object);
  std::vector<Refined> different;
  for (std::size_t i : best_of(final_poses, set, refined.size(),
                               [&](std::size_t i) { return -merit(refined[i].by_view); }))
    different.push_back(refined[i]);
  return different;
}

}  // namespace edgescout
