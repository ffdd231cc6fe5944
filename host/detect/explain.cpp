#include "host/detect/explain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/detect/keyed_poses.h"
#include "host/detect/search_space.h"
#include "host/detect/suppression.h"
#include "host/detect/template_support.h"
#include "host/model/viewpoint_index.h"
#include "host/register/pose_classifier.h"
#include "host/register/thresholds.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

using Poses = std::vector<PoseEstimate>;
using Index = std::optional<std::size_t>;

double rank_of(const PoseEstimate& pose) { return PoseClassifier::rank(pose.features); }
double probability(const PoseEstimate& pose) { return PoseClassifier::probability(pose.features); }

// `size_px` of 0 reaches to the image's border.
bool is_between(double px, double from_px, double size_px, int image_px) {
  const double border_px = image_px - 0.5,
               end_px = size_px > 0 ? std::min(from_px + size_px, border_px) : border_px;
  return px >= std::max(from_px, -0.5) && px < end_px;
}

Object object_of(const TemplateSet& set) { return {set.object_id, set.model.mesh, set.symmetries}; }

// Compares hits with the given pose. Those that pass lie so near that alignment should move them
// there: no corner of the object's box is further from its place in the image than a quarter of the
// object's size there. In rendered scenes half of such hits were aligned to the true pose, and nine
// of ten hits that were aligned to it were such.
SamePose near_the(const ObjectPose& given, const TemplateSet& set, const Camera& camera) {
  constexpr double fraction = 0.25;
  Object box = object_of(set);
  const Mesh& mesh = set.model.mesh;
  box.mesh.vertices_m.clear();
  for (const double x_m : {mesh.box_min_m.x(), mesh.box_max_m.x()})
    for (const double y_m : {mesh.box_min_m.y(), mesh.box_max_m.y()})
      for (const double z_m : {mesh.box_min_m.z(), mesh.box_max_m.z()})
        box.mesh.vertices_m.emplace_back(x_m, y_m, z_m);
  const double distance_m = (given.world_from_object * set.model.center_m).norm();
  SamePoseOptions near;
  near.max_mspd_px = fraction * mesh.diameter_m * camera.fx / distance_m;
  return {box, camera, given.world_from_object, near};
}

// Poses that a stage held, with their errors from the given pose in units of the bounds (SamePose);
// infinite for another object.
struct HeldPoses {
  Poses poses;
  std::vector<double> of_bounds;
};

// Looks for one given pose in what every stage held.
class LostPose {
 public:
  LostPose(const Scene& scene, const TemplateSet& set, const DetectTrace& trace,
           const ObjectPose& given, const DetectOptions& options, const SamePoseOptions& same)
      : scene_(scene),
        view_(scene.views[0]),
        set_(set),
        given_(given),
        options_(options),
        is_same_(object_of(set), view_.camera, given.world_from_object, same),
        is_near_(near_the(given, set, view_.camera)),
        space_(trace.world, set.model, Se3{}),
        search_(trace.searches[std::size_t(given.object)]),
        medium_(of_search(search_.medium)),
        candidates_(of_search(search_.candidates)),
        fine_(of_search(search_.fine)),
        selection_(trace.selection),
        competing_(compared(selection_.competing)) {}

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
    report.rival = rival(report);
    return report;
  }

 private:
  double of_bounds(const ObjectPose& pose) const {
    return pose.object == given_.object ? is_same_.of_bounds(pose.world_from_object) : INFINITY;
  }

  HeldPoses compared(Poses poses) const {
    HeldPoses held{std::move(poses), {}};
    for (const PoseEstimate& pose : held.poses) held.of_bounds.push_back(of_bounds(pose));
    return held;
  }

  // Poses of a search do not have the index of their object.
  HeldPoses of_search(Poses poses) const {
    for (PoseEstimate& pose : poses) pose.object = given_.object;
    return compared(std::move(poses));
  }

  FoundPose found(const PoseEstimate& pose) const {
    const Se3& camera_from_object = pose.world_from_object;
    const bool is_other = pose.object != given_.object;
    return {pose, is_other ? PoseError{} : is_same_.error(camera_from_object),
            is_other ? 0 : is_same_.mspd_px(camera_from_object), probability(pose),
            pool_over_views(pose.features)};
  }
  std::optional<FoundPose> found(const HeldPoses& held, Index index) const {
    return index ? std::optional(found(held.poses[*index])) : std::nullopt;
  }

  // The pose with the smallest error.
  static Index nearest(const HeldPoses& held) {
    const auto least = std::ranges::min_element(held.of_bounds);
    if (least == held.of_bounds.end()) return std::nullopt;
    return std::size_t(least - held.of_bounds.begin());
  }

  // Of the poses that are the same as the given one, that with the largest value.
  template <typename Value>
  static Index best_same(const HeldPoses& held, const Value& value) {
    Index best;
    for (std::size_t i = 0; i < held.poses.size(); ++i)
      if (held.of_bounds[i] < 1 && (!best || value(held.poses[i]) > value(held.poses[*best])))
        best = i;
    return best;
  }

  RangeReport range() const {
    const TemplateOptions& searched = set_.options;
    const ImageRegion& region = options_.scan.within;
    const Camera& camera = view_.camera;
    const Eigen::Vector3d center_m = given_.world_from_object * set_.model.center_m;
    const Eigen::Vector2d center_px = project(camera, center_m);
    const double cosine = ViewpointIndex(set_).nearest(given_.world_from_object).cosine;
    RangeReport range;
    range.distance_m = center_m.norm();
    range.distance_min_m = searched.distance_min_m;
    range.distance_max_m = searched.distance_max_m;
    range.viewpoint_angle_rad = std::acos(std::clamp(cosine, -1.0, 1.0));
    range.in_distances =
        range.distance_m >= searched.distance_min_m && range.distance_m <= searched.distance_max_m;
    range.in_viewpoints = range.viewpoint_angle_rad <= ICOSPHERE_GAP_RAD / searched.frequency;
    range.in_region = is_between(center_px.x(), region.x, region.width, camera.width) &&
                      is_between(center_px.y(), region.y, region.height, camera.height);
    range.in_prior = space_.admits(given_.world_from_object);
    return range;
  }

  EdgesReport edges() const {
    const PoseFeatures features = features_by_view(scene_, {&given_, 1})(0, 0);
    if (!(features.points > 0))
      throw InputError("given pose", "t", "an object of which the image shows no edge",
                       "one inside the image");
    return {features.visible, features.points, features.support};
  }

  bool is_near_start(std::size_t start) const {
    return is_near_(search_.starts[start].world_from_object);
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
        scan_mean_px(set_, view_, given_.world_from_object, scene_.backend, options_.scan);
    KeyedPoses hits;
    Index best;
    for (const ScanHit& hit : search_.hits) {
      if (is_near_(hit.pose.world_from_object) && (!best || hit.rank < hits.keys[*best]))
        best = hits.poses.size();
      hits.add(hit.pose.world_from_object, hit.rank);
    }
    if (!best) return scan;
    scan.mean_px = search_.hits[*best].mean_px;
    const Index start = best_near_start();
    const KeyedPoses better = hits.better_than(*best);
    scan.rank =
        start ? *start + 1 : 1 + better.best_distinct_starts_of(set_, better.poses.size()).size();
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
    static_cast<ObjectPose&>(given) = given_;
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
    alignment.same = std::size_t(
        std::ranges::count_if(medium_.of_bounds, [](double error) { return error < 1; }));
    alignment.nearest = found(medium_, nearest(medium_));
    alignment.best_hit_became = found(medium_, best_near_medium());
    return alignment;
  }

  RankingReport ranking() const {
    RankingReport ranking;
    ranking.candidates = candidates_.poses.size();
    if (ranking.candidates > 0) ranking.last_log_odds = rank_of(candidates_.poses.back());
    Poses own = register_poses(scene_, {&given_, 1}, options_.medium);
    measure_features(scene_, own, {options_.refine.score, options_.medium.visibility});
    ranking.own_log_odds = rank_of(own[0]);
    const Index aligned = best_same(medium_, rank_of), candidate = best_same(candidates_, rank_of);
    if (!aligned) return ranking;
    ranking.is_candidate = candidate.has_value();
    ranking.log_odds = rank_of(medium_.poses[*aligned]);
    ranking.rank = candidate ? *candidate + 1 : rank_of_aligned(*aligned);
    return ranking;
  }

  // From 1, among distinct poses.
  std::size_t rank_of_aligned(std::size_t index) const {
    KeyedPoses aligned;
    for (const PoseEstimate& pose : medium_.poses)
      aligned.add(pose.world_from_object, -rank_of(pose));
    const KeyedPoses better = aligned.better_than(index);
    return 1 + better.best_distinct_of(set_, better.poses.size()).size();
  }

  RefinementReport refinement() const {
    return {found(fine_, best_same(fine_, probability)), found(fine_, nearest(fine_)),
            found(refine_poses(scene_, {&given_, 1}, options_.refine)[0])};
  }

  SelectionReport selection() const {
    SelectionReport selection;
    const Index competing = best_same(competing_, probability);
    if (!competing) return selection;
    const PoseEstimate& pose = competing_.poses[*competing];
    selection.competes = true;
    selection.above_chance = psi_z_score(pool_over_views(pose.features)) > 0;
    const Poses selected = selected_estimates(selection_);
    std::vector<ObjectPose> others;
    for (std::size_t i = 0; i < selected.size(); ++i)
      if (of_bounds(selected[i]) >= 1)
        others.push_back(selected[i]);
      else if (!selection.selected)
        selection.selected = found(selected[i]), selection.rank = i + 1;
    selection.claimed = claimed_fraction(scene_, pose, others, options_.edge_claims);
    selection.is_reported =
        selection.selected && selection.rank <= std::size_t(options_.max_detections);
    return selection;
  }

  // The stage after the last one that held the pose.
  LossStage lost_at(const LossReport& report) const {
    if (report.selection.is_reported) return LossStage::Reported;
    if (const Index competing = best_same(competing_, probability))
      return probability(competing_.poses[*competing]) < options_.min_probability
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

  std::optional<Rival> rival(const LossReport& report) const {
    switch (report.lost_at) {
      case LossStage::Alignment:
        return Rival{*report.alignment.best_hit_became};
      case LossStage::Ranking:
        return best_claimant(medium_.poses[*best_same(medium_, rank_of)], candidates_.poses);
      case LossStage::Refinement:
        return Rival{*report.refinement.nearest};
      case LossStage::Selection:
        return winner();
      default:
        return std::nullopt;
    }
  }

  std::optional<Rival> winner() const {
    const Poses& competing = competing_.poses;
    const Index lost = best_same(competing_, probability);
    if (!lost) return better_duplicate();
    std::optional<Rival> winner = best_claimant(competing[*lost], selected_estimates(selection_));
    if (winner)
      winner->is_restarted =
          std::any_of(competing.begin() + std::ptrdiff_t(selection_.first_restarted),
                      competing.end(), [&](const PoseEstimate& p) { return is_copy(p, *winner); });
    return winner;
  }

  // Of the poses that are not the same as the given one, that which claims most of the edges that
  // the lost pose explains. None where no pose claims any.
  std::optional<Rival> best_claimant(const ObjectPose& lost, const Poses& poses) const {
    std::optional<Rival> best;
    for (const PoseEstimate& pose : poses) {
      if (of_bounds(pose) < 1) continue;
      const ObjectPose claimant = pose;
      const double claimed = claimed_fraction(scene_, lost, {&claimant, 1}, options_.edge_claims);
      if (claimed > (best ? best->claimed : 0)) best = Rival{found(pose), claimed};
    }
    return best;
  }

  // The best of the poses after the fine stage that are one pose with the lost one to detection.
  std::optional<Rival> better_duplicate() const {
    const Mesh& mesh = set_.model.mesh;
    const PoseEstimate& lost = fine_.poses[*best_same(fine_, probability)];
    const PoseEstimate* best = nullptr;
    for (const PoseEstimate& pose : fine_.poses)
      if (probability(pose) >= probability(best ? *best : lost) &&
          pose_distance_m(pose.world_from_object, lost.world_from_object, mesh, set_.symmetries) <
              thresholds::SAME_POSE * mesh.diameter_m)
        best = &pose;
    return Rival{found(*best)};
  }

  const Scene& scene_;
  const ObjectView& view_;
  const TemplateSet& set_;
  const ObjectPose given_;
  const DetectOptions& options_;
  SamePose is_same_, is_near_;
  SearchSpace space_;
  const SearchTrace& search_;
  HeldPoses medium_, candidates_, fine_;
  const SelectionTrace& selection_;
  HeldPoses competing_;
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
