#include "host/detect/explain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/detect/keyed_poses.h"
#include "host/detect/rival.h"
#include "host/detect/search_space.h"
#include "host/detect/template_support.h"
#include "host/model/viewpoint_index.h"
#include "host/register/pose_classifier.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

using Index = std::optional<std::size_t>;

// `size_px` of 0 reaches to the image's border.
bool is_between(double px, double from_px, double size_px, int image_px) {
  const double border_px = image_px - 0.5,
               end_px = size_px > 0 ? std::min(from_px + size_px, border_px) : border_px;
  return px >= std::max(from_px, -0.5) && px < end_px;
}

// Looks for one given pose in what every stage held.
class LostPose {
 public:
  LostPose(const Scene& scene, const TemplateSet& set, const DetectTrace& trace,
           const ObjectPose& given, const DetectOptions& options, const SamePoseOptions& same)
      : scene_(scene),
        view_(scene.views[0]),
        camera_(trace.camera),
        set_(set),
        given_(set, camera_, given, same),
        options_(options),
        space_(trace.world, set.model, Se3{}),
        search_(trace.searches[std::size_t(given.object)]),
        stages_(given_.compared(trace)) {}

  LossReport report() const {
    LossReport report;
    report.range = range();
    report.edges = edges();
    report.scan = scan();
    report.support = support();
    report.alignment = alignment();
    report.ranking = ranking();
    report.refinement = refinement();
    report.selection = selection();
    report.lost_at = lost_at(report);
    report.rival = find_rival(report, scene_, set_, given_, stages_, options_.edge_claims);
    return report;
  }

 private:
  RangeReport range() const {
    const TemplateOptions& searched = set_.options;
    const ImageRegion& region = options_.scan.within;
    const Eigen::Vector3d center_m = given_.pose().world_from_object * set_.model.center_m;
    const Eigen::Vector2d center_px = project(camera_, center_m);
    const double cosine = ViewpointIndex(set_).nearest(given_.pose().world_from_object).cosine;
    RangeReport range;
    range.distance_m = center_m.norm();
    range.distance_min_m = searched.distance_min_m;
    range.distance_max_m = searched.distance_max_m;
    range.viewpoint_angle_rad = std::acos(std::clamp(cosine, -1.0, 1.0));
    range.in_distances =
        range.distance_m >= searched.distance_min_m && range.distance_m <= searched.distance_max_m;
    range.in_viewpoints = range.viewpoint_angle_rad <= ICOSPHERE_GAP_RAD / searched.frequency;
    range.in_region = is_between(center_px.x(), region.x, region.width, camera_.width) &&
                      is_between(center_px.y(), region.y, region.height, camera_.height);
    range.in_prior = space_.admits(given_.pose().world_from_object);
    return range;
  }

  EdgesReport edges() const {
    const PoseFeatures features = features_by_view(scene_, {&given_.pose(), 1})(0, 0);
    if (!(features.points > 0))
      throw InputError("given pose", "t", "an object of which the image shows no edge",
                       "one inside the image");
    return {features.visible, features.points, features.support};
  }

  bool is_near_start(std::size_t start) const {
    return given_.is_near(search_.starts[start].world_from_object);
  }

  Index best_near_start() const {
    for (std::size_t i = 0; i < search_.starts.size(); ++i)
      if (is_near_start(i)) return i;
    return std::nullopt;
  }

  ScanReport scan() const {
    ScanReport scan;
    scan.hits = search_.hits.size();
    scan.aligned = search_.starts.size();
    for (std::size_t i = 0; i < search_.starts.size(); ++i)
      if (is_near_start(i)) ++scan.aligned_near;
    scan.own_mean_px =
        scan_mean_px(set_, view_, given_.pose().world_from_object, scene_.backend, options_.scan);
    KeyedPoses hits;
    Index best;
    for (const ScanHit& hit : search_.hits) {
      if (given_.is_near(hit.pose.world_from_object) && (!best || hit.rank < hits.keys[*best]))
        best = hits.poses.size();
      hits.add(hit.pose.world_from_object, hit.rank);
    }
    if (!best) return scan;
    scan.mean_px = search_.hits[*best].mean_px;
    const Index start = best_near_start();
    const KeyedPoses better = hits.better_than(*best);
    scan.rank = start ? *start + 1
                      : 1 + better
                                .best_distinct_starts_of(set_, better.poses.size(),
                                                         scene_.backend.threads())
                                .size();
    return scan;
  }

  // The best pose of the medium stage that a hit near the given pose became.
  Index best_near_medium() const {
    const std::vector<std::size_t>& starts = search_.medium_starts;
    const auto best =
        std::ranges::find_if(starts, [&](std::size_t start) { return is_near_start(start); });
    if (best == starts.end()) return std::nullopt;
    return std::size_t(best - starts.begin());
  }

  SupportReport support() const {
    SupportReport support;
    PoseEstimate given;
    static_cast<ObjectPose&>(given) = given_.pose();
    given.object = 0;
    const Scene scene{{&set_.model, 1}, scene_.views, scene_.backend};
    const auto rank = [](const PoseFeatures& features) { return PoseClassifier::rank(features); };
    support.own = rank(template_support(set_, scene, {given})[0]);
    support.medium = search_.medium_starts.size();
    support.medium_near = std::size_t(std::ranges::count_if(
        search_.medium_starts, [&](std::size_t start) { return is_near_start(start); }));
    std::vector<PoseEstimate> near;
    for (std::size_t i = 0; i < search_.starts.size(); ++i)
      if (is_near_start(i)) near.push_back(search_.coarse[i]);
    const std::vector<PoseFeatures> features = template_support(set_, scene, near);
    if (!near.empty()) support.best_near = rank(std::ranges::max(features, {}, rank));
    if (support.medium > 0)
      support.last =
          rank(template_support(set_, scene, {search_.coarse[search_.medium_starts.back()]})[0]);
    return support;
  }

  AlignmentReport alignment() const {
    AlignmentReport alignment;
    alignment.same = stages_.medium.count_same();
    alignment.nearest = given_.found(stages_.medium, stages_.medium.nearest());
    alignment.best_hit_became = given_.found(stages_.medium, best_near_medium());
    return alignment;
  }

  RankingReport ranking() const {
    RankingReport ranking;
    ranking.candidates = stages_.candidates.poses.size();
    if (ranking.candidates > 0) ranking.last_log_odds = rank_of(stages_.candidates.poses.back());
    std::vector<PoseEstimate> own = register_poses(scene_, {&given_.pose(), 1}, options_.medium);
    measure_features(scene_, own, {options_.refine.score, options_.medium.visibility});
    ranking.own_log_odds = rank_of(own[0]);
    const Index aligned = stages_.medium.best_same(rank_of),
                candidate = stages_.candidates.best_same(rank_of);
    if (!aligned) return ranking;
    ranking.is_candidate = candidate.has_value();
    ranking.log_odds = rank_of(stages_.medium.poses[*aligned]);
    ranking.rank = candidate ? *candidate + 1 : rank_of_aligned(*aligned);
    return ranking;
  }

  // From 1, among distinct poses.
  std::size_t rank_of_aligned(std::size_t index) const {
    KeyedPoses aligned;
    for (const PoseEstimate& pose : stages_.medium.poses)
      aligned.add(pose.world_from_object, -rank_of(pose));
    const KeyedPoses better = aligned.better_than(index);
    return 1 + better.best_distinct_of(set_, better.poses.size()).size();
  }

  RefinementReport refinement() const {
    return {given_.found(stages_.fine, stages_.fine.best_same(probability_of)),
            given_.found(stages_.fine, stages_.fine.nearest()),
            given_.found(refine_poses(scene_, {&given_.pose(), 1}, options_.refine)[0])};
  }

  SelectionReport selection() const {
    SelectionReport selection;
    const Index competing = stages_.competing.best_same(probability_of);
    if (!competing) return selection;
    const PoseEstimate& pose = stages_.competing.poses[*competing];
    selection.competes = true;
    selection.above_chance = pose.classification.psi_z_score > 0;
    const std::vector<PoseEstimate> selected = selected_estimates(stages_.selection);
    std::vector<ObjectPose> others;
    for (std::size_t i = 0; i < selected.size(); ++i)
      if (given_.of_bounds(selected[i]) >= 1)
        others.push_back(selected[i]);
      else if (!selection.selected) {
        selection.selected = given_.found(selected[i]), selection.rank = i + 1;
        // What it shares with its alternatives is not in the estimate.
        selection.selected->probability = stages_.selection.selected[i].probability;
      }
    selection.claimed = claimed_fraction(scene_, pose, others, options_.edge_claims);
    selection.is_reported =
        selection.selected && selection.rank <= std::size_t(options_.max_detections);
    if (!selection.selected && probability_of(pose) >= options_.min_probability)
      add_sharing(selection);
    return selection;
  }

  // Of a pose that is probable enough by itself.
  void add_sharing(SelectionReport& selection) const {
    const std::vector<Detection>& less_probable = stages_.selection.less_probable;
    const auto same = std::ranges::find_if(
        less_probable, [&](const Detection& d) { return given_.of_bounds(d) < 1; });
    if (same == less_probable.end()) return;
    selection.shared_probability = same->probability;
    selection.alternatives = same->alternatives.size();
  }

  // The stage after the last one that held the pose.
  LossStage lost_at(const LossReport& report) const {
    if (report.selection.is_reported) return LossStage::Reported;
    if (report.selection.shared_probability) return LossStage::Probability;
    if (const Index competing = stages_.competing.best_same(probability_of))
      return probability_of(stages_.competing.poses[*competing]) < options_.min_probability
                 ? LossStage::Probability
                 : LossStage::Selection;
    if (const auto& same = report.refinement.same)
      return same->probability < options_.min_probability ? LossStage::Probability
                                                          : LossStage::Selection;
    if (report.ranking.is_candidate) return LossStage::Refinement;
    if (report.alignment.same > 0) return LossStage::Ranking;
    // Hits lie near any pose by chance; what is not searched or not visible was not found by them.
    if (!report.range.holds()) return LossStage::Range;
    if (!report.edges.exceeds_copies()) return LossStage::Edges;
    if (report.scan.aligned_near == 0) return LossStage::Scan;
    return report.support.medium_near > 0 ? LossStage::Alignment : LossStage::Support;
  }

  const Scene& scene_;
  const ObjectView& view_;  // as it was searched
  const Camera& camera_;    // of the image as it was given
  const TemplateSet& set_;
  const GivenPose given_;
  const DetectOptions& options_;
  SearchSpace space_;
  const SearchTrace& search_;
  const ComparedStages stages_;
};

}  // namespace

std::string to_string(LossStage stage) {
  constexpr std::array names{"range",   "edges",      "scan",        "support",   "alignment",
                             "ranking", "refinement", "probability", "selection", "reported"};
  return names[std::size_t(stage)];
}

LossReport explain_loss(const Scene& scene, const TemplateSet& set, const DetectTrace& trace,
                        const ObjectPose& given, const DetectOptions& options,
                        const SamePoseOptions& same) {
  same.validate();
  check(given.object >= 0 && std::size_t(given.object) < trace.searches.size(),
        "explain_loss: an object that is not in the trace");
  const SearchTrace& search = trace.searches[std::size_t(given.object)];
  check(scene.views.size() == 1 && search.medium.size() == search.medium_starts.size() &&
            search.fine.size() == search.candidates.size(),
        "explain_loss: one view, no known instances");
  require_rigid(given.world_from_object, "given pose", "R, t");
  if (!((given.world_from_object * set.model.center_m).z() > 0))
    throw InputError("given pose", "t", "an object behind the camera", "one in front of it");
  return LostPose(scene, set, trace, given, options, same).report();
}

}  // namespace edgescout
