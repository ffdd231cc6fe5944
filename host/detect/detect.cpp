#include "host/detect/detect.h"

#include <optional>

#include "host/detect/distinct_poses.h"
#include "host/detect/keyed_poses.h"
#include "host/detect/search_space.h"
#include "host/detect/support_views.h"
#include "host/detect/template_support.h"
#include "host/register/coarse_registration.h"
#include "host/register/pose_classifier.h"
#include "host/register/thresholds.h"

namespace edgescout {

namespace {

template <typename T>
std::vector<T> entries_at(const std::vector<std::size_t>& indices, const std::vector<T>& entries) {
  std::vector<T> chosen;
  for (const std::size_t i : indices) chosen.push_back(entries[i]);
  return chosen;
}

KnownPoses known_in_camera(std::span<const Se3> known_in_world, const TemplateSet& set,
                           const Se3& camera_from_world) {
  std::vector<Se3> in_camera;
  for (const Se3& pose : known_in_world) in_camera.push_back(camera_from_world * pose);
  return {in_camera, set.model.mesh, set.symmetries};
}

// The searched view and those that support it. The camera frame of the searched one is the world.
std::vector<ObjectView> views_around(const ObjectView& searched,
                                     std::span<const ObjectView> support) {
  std::vector<ObjectView> views(support.begin(), support.end());
  views.insert(views.begin(), searched);
  const Se3 world_from_searched = inverse(searched.camera_from_world);
  for (ObjectView& view : views)
    view.camera_from_world = view.camera_from_world * world_from_searched;
  views[0].camera_from_world = Se3{};
  return views;
}

// The stages of detect.h's table for one object. `search` has the supporting views that take part.
class Cascade {
 public:
  Cascade(const ObjectSearch& search, std::span<const Se3> known_in_world,
          const DetectOptions& options)
      : set_(search.set),
        backend_(search.backend),
        limit_(search.limit),
        options_(options),
        views_(views_around(search.view, search.support)),
        known_(known_in_camera(known_in_world, set_, search.view.camera_from_world)) {
    if (options.scan.world.is_given())
      space_.emplace(options.scan.world, set_.model, search.view.camera_from_world);
  }

  // Drops those that alignment would move to a known instance.
  void drop_near_known(std::vector<ScanHit>& hits) const {
    std::erase_if(hits, [&](const ScanHit& hit) {
      return is_known(hit.pose.world_from_object, thresholds::NEAR_KNOWN);
    });
  }

  // The best distinct hits of every scale.
  std::vector<ObjectPose> starts(std::span<const ScanHit> hits) const {
    const std::size_t scales = distance_scales(set_.options).size(),
                      most = share_of_scale(
                          number(is_joint() ? options_.coarse_poses_joint : options_.coarse_poses),
                          set_);
    std::vector<ObjectPose> starts;
    for (std::size_t scale = 0; scale < scales; ++scale) {
      KeyedPoses poses;
      for (const ScanHit& hit : hits)
        if (std::size_t(hit.scale) == scale) poses.add(hit.pose.world_from_object, hit.rank);
      // Several images show the distance, in which starts of one image hardly differ.
      for (const std::size_t i :
           is_joint() ? poses.best_distinct_of(set_, most)
                      : poses.best_distinct_starts_of(set_, most, backend_.threads()))
        starts.push_back({0, poses.poses[i]});
    }
    return starts;
  }

  // Aligns the starts' templates on the coarse tensors.
  std::vector<PoseEstimate> coarse(std::span<const ObjectPose> starts) const {
    return register_coarsely(scene_of(views_), set_, starts, options_.coarse);
  }

  // Indices of the aligned poses that enter the medium stage, best first.
  std::vector<std::size_t> medium_starts(const std::vector<PoseEstimate>& aligned) const {
    std::vector<double> keys;
    for (const PoseFeatures& features : template_support(set_, scene_of(views_), aligned))
      keys.push_back(-PoseClassifier::rank(features));
    const std::size_t most =
        number(is_joint() ? options_.medium_poses_joint : options_.medium_poses);
    return best_admitted(aligned, keys,
                         {.most = most, .distance_ratio = set_.options.distance_ratio});
  }

  // Aligns poses on the full tensors and measures their features.
  std::vector<PoseEstimate> medium(std::span<const PoseEstimate> aligned,
                                   std::span<const std::size_t> indices) const {
    std::vector<ObjectPose> starts;
    for (const std::size_t i : indices) starts.push_back(aligned[i]);
    std::vector<PoseEstimate> poses = register_poses(scene_of(views_), starts, options_.medium);
    measure_features(scene_of(views_), poses, {options_.refine.score, options_.medium.visibility});
    return poses;
  }

  // The highest ranks among distinct poses of unknown instances.
  std::vector<PoseEstimate> candidates(const std::vector<PoseEstimate>& aligned) const {
    std::vector<double> keys;
    for (const PoseEstimate& pose : aligned) keys.push_back(-pose.classification.rank);
    return entries_at(
        best_admitted(aligned, keys,
                      {.most = std::size_t(options_.candidates), .drops_known = true}),
        aligned);
  }

  std::vector<PoseEstimate> fine(const std::vector<PoseEstimate>& candidates) const {
    RefineOptions refine = options_.refine;
    if (is_joint()) refine.search.rotation_rad = 0;  // several views bring starts near enough
    return refine_poses(scene_of(views_), object_poses(candidates), refine);
  }

  // Distinct poses of unknown instances, most probable first.
  std::vector<PoseEstimate> most_probable(const std::vector<PoseEstimate>& refined) const {
    std::vector<double> keys;
    for (const PoseEstimate& pose : refined) keys.push_back(-pose.classification.probability);
    return entries_at(best_admitted(refined, keys, {.most = refined.size(), .drops_known = true}),
                      refined);
  }

 private:
  bool is_joint() const { return views_.size() > 1; }

  // How many poses enter a stage. Where no time is left, no more than will be candidates: they only
  // get their features.
  std::size_t number(int of_stage) const {
    return std::size_t(limit_ && limit_->is_over() ? std::min(of_stage, options_.candidates)
                                                   : of_stage);
  }

  Scene scene_of(std::span<const ObjectView> views) const {
    return {{&set_.model, 1}, views, backend_, limit_};
  }

  // A pose that registration has shrunk onto one edge of the image matches it well.
  bool is_at_searched_distance(const Se3& camera_from_object) const {
    const double distance_m = (camera_from_object * set_.model.center_m).norm();
    return distance_m * thresholds::DISTANCE_SLACK > set_.options.distance_min_m &&
           distance_m < set_.options.distance_max_m * thresholds::DISTANCE_SLACK;
  }

  bool is_known(const Se3& camera_from_object, double of_diameter) const {
    return known_.any_within(of_diameter * set_.model.mesh.diameter_m, camera_from_object);
  }

  // Which poses a stage takes.
  struct Intake {
    std::size_t most;
    double distance_ratio = 1;  // as SearchSlack: registration may still move a pose so far
    bool drops_known = false;
  };

  // The best distinct poses of those at a searched distance that the prior admits or that may still
  // be moved there.
  std::vector<std::size_t> best_admitted(const std::vector<PoseEstimate>& poses,
                                         const std::vector<double>& keys,
                                         const Intake& intake) const {
    const SearchSlack slack{thresholds::SAME_POSE * set_.model.mesh.diameter_m,
                            intake.distance_ratio};
    std::vector<std::size_t> indices;
    KeyedPoses admitted;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Se3& pose = poses[i].world_from_object;
      if (!is_at_searched_distance(pose) || (space_ && !space_->admits(pose, slack)) ||
          (intake.drops_known && is_known(pose, thresholds::SAME_POSE)))
        continue;
      indices.push_back(i);
      admitted.add(pose, keys[i]);
    }
    return entries_at(admitted.best_distinct_of(set_, intake.most), indices);
  }

  const TemplateSet& set_;
  Backend& backend_;
  const TimeLimit* limit_;
  const DetectOptions& options_;
  std::vector<ObjectView> views_;  // the searched view first; its camera frame is the world
  KnownPoses known_;
  std::optional<SearchSpace> space_;  // none: no prior is given
};

ObjectSearch with_support(const ObjectSearch& search, std::span<const ObjectView> support) {
  return {search.set, search.view, support, search.backend, search.watch, search.limit};
}

// From hits that are rescored in the supporting views.
std::vector<PoseEstimate> run_cascade(const Cascade& cascade, std::span<const ScanHit> hits,
                                      Stopwatch* watch, SearchTrace* trace = nullptr) {
  const auto lap = [&](const char* stage) {
    if (watch) watch->lap(stage);
  };
  lap("scan");
  SearchTrace stages;
  stages.starts = cascade.starts(hits);
  stages.coarse = cascade.coarse(stages.starts);
  lap("coarse");
  stages.medium_starts = cascade.medium_starts(stages.coarse);
  stages.medium = cascade.medium(stages.coarse, stages.medium_starts);
  lap("medium");
  stages.candidates = cascade.candidates(stages.medium);
  stages.fine = cascade.fine(stages.candidates);
  std::vector<PoseEstimate> found = cascade.most_probable(stages.fine);
  lap("fine");
  if (trace) {
    stages.hits.assign(hits.begin(), hits.end());
    *trace = std::move(stages);
  }
  return found;
}

}  // namespace

PoseFilter near_known(std::span<const Se3> known_in_world, const TemplateSet& set,
                      const Se3& camera_from_world) {
  return
      [known = known_in_camera(known_in_world, set, camera_from_world),
       radius_m = thresholds::NEAR_KNOWN * set.model.mesh.diameter_m](
          const Se3& camera_from_object) { return known.any_within(radius_m, camera_from_object); };
}

std::vector<PoseEstimate> find_candidates(const ObjectSearch& search,
                                          std::span<const Se3> known_in_world,
                                          const DetectOptions& options, SearchTrace* trace) {
  const std::vector<ObjectView> support =
      support_views(search.view, search.support, std::size_t(options.support_views));
  const ObjectSearch supported = with_support(search, support);
  std::vector<ScanHit> hits = rescore_in_views(
      supported, coarse_scan(search.set, search.view, search.backend, options.scan, search.limit),
      options.scan);
  const Cascade cascade(supported, known_in_world, options);
  cascade.drop_near_known(hits);
  return run_cascade(cascade, hits, search.watch, trace);
}

std::vector<PoseEstimate> find_candidates(const ObjectSearch& search,
                                          std::span<const ScanHit> rescored,
                                          std::span<const Se3> known_in_world,
                                          const DetectOptions& options) {
  const std::vector<ObjectView> support =
      support_views(search.view, search.support, std::size_t(options.support_views));
  const Cascade cascade(with_support(search, support), known_in_world, options);
  return run_cascade(cascade, rescored, search.watch);
}

}  // namespace edgescout
