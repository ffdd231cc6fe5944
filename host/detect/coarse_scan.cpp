#include "host/detect/coarse_scan.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "host/core/thinned.h"
#include "host/detect/admitted_search.h"
#include "host/detect/scan_regions.h"
#include "host/detect/searched_scale.h"
#include "host/detect/template_projection.h"
#include "host/register/coarse_registration.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"
#include "kernels/unfilled.h"

namespace edgescout {

namespace {

// The points of every viewpoint, evenly thinned, in the backend's memory.
struct ScannedPoints {
  std::vector<ViewpointPoints> of_viewpoint;
  ModelPointsHandle points;

  ScannedPoints(const TemplateSet& set, int most, Backend& backend) {
    std::vector<ModelPoint> all;
    for (const TemplateView& view : set.views) {
      const std::vector<ModelPoint> kept = thinned(view.points, most);
      of_viewpoint.push_back({std::uint32_t(all.size()), std::uint32_t(kept.size())});
      all.insert(all.end(), kept.begin(), kept.end());
    }
    points = backend.make_model_points(all);
  }
};

// Scans all regions of one scale: all templates with few points, the best of them with all.
class RegionScan {
 public:
  // `hits` is memory that the scans of an image share.
  // `admitted`: null where everything is.
  RegionScan(const SearchedScale& scale, const AdmittedSearch* admitted,
             std::span<const ScanRegion> regions, Backend& backend, const ScanOptions& options,
             Unfilled<TemplateHit>& hits)
      : scale_(scale), admitted_(admitted), backend_(backend), options_(options), hits_(hits) {
    for (const double distance_m : scale.numbering.distances_m) {
      distances_m_.push_back(float(distance_m));
      size_weights_.push_back(scan_size_weight(distance_m));
    }
    for (const ScanRegion& region : regions) add_region(region);
    turn_templates();
  }

  // Of every region the hits of the lowest ranks, at most `most`, best first.
  std::vector<ScanHit> best(std::size_t most) {
    std::vector<std::uint32_t> all(scale_.numbering.count());
    std::iota(all.begin(), all.end(), 0u);
    const int quick_points = std::min(options_.quick_points, options_.points);
    const Ranked by_few_points =
        best_in_regions(quick_points, all, true, std::size_t(options_.quick_kept) * most);
    return hits_of(best_in_regions(options_.points, numbers_of(by_few_points), false, most));
  }

 private:
  using Ranked = std::vector<std::vector<ScoredTemplate>>;  // by region, best first

  // One that the prior leaves anchors of.
  void add_region(const ScanRegion& region) {
    const std::vector<std::optional<ScanRegion>> parts =
        admitted_ ? admitted_->parts_of(region)
                  : std::vector<std::optional<ScanRegion>>(distances_m_.size(), region);
    if (std::ranges::none_of(parts, &std::optional<ScanRegion>::has_value)) return;
    const Eigen::Vector3f ray =
        ray_through(scale_.level.camera, region.middle).normalized().cast<float>();
    middles_.push_back(region.middle);
    regions_.push_back(
        {float(region.middle.x()), float(region.middle.y()), ray.x(), ray.y(), ray.z()});
    for (const std::optional<ScanRegion>& part : parts)
      anchors_.push_back(part ? TemplateAnchors{part->x0, part->y0, std::uint32_t(part->columns),
                                                std::uint32_t(part->rows)}
                              : TemplateAnchors{});
  }

  // Templates of one viewpoint and turn share their rotation at every distance.
  void turn_templates() {
    const TemplateNumbering& numbering = scale_.numbering;
    const std::size_t turns = numbering.count() / numbering.distances_m.size();
    turned_.resize(regions_.size() * turns);
    for_each_in_chunks(backend_.threads(), turned_.size(), 64, [&](std::size_t i) {
      const std::size_t number = i % turns * numbering.distances_m.size();
      turned_[i] = to_pose(place_template(
          scale_.set, scale_.set.views[std::size_t(numbering.viewpoint(number))],
          numbering.in_plane_rad(number), 0, middles_[i / turns], scale_.level.camera));
    });
  }

  // Of the templates of these numbers, `points` of each, the best `most` of every region.
  Ranked best_in_regions(int points, std::span<const std::uint32_t> numbers, bool same_numbers,
                         std::size_t most) {
    const ScannedPoints scanned(scale_.set, points, backend_);
    const ReducedTensors& level = scale_.level;
    const TemplateScan scan{
        {level.salient->intrinsics, level.salient->shape.bins, nearest_drawn_m(scale_.set)},
        options_.anchor_step,
        std::uint32_t(scale_.numbering.in_plane_steps),
        scanned.of_viewpoint,
        distances_m_,
        regions_,
        anchors_,
        turned_,
        numbers,
        same_numbers};
    if (hits_.size() < scan.hits()) hits_.resize(scan.hits());
    backend_.template_scan(*level.salient, *scanned.points, scan,
                           std::span(hits_).first(scan.hits()));
    Ranked ranked(regions_.size());
    backend_.threads().for_each(regions_.size(), [&](std::size_t region) {
      ranked[region] = best_of_region(scan, region, most);
    });
    return ranked;
  }

  // As much of a template's score as decides its order.
  struct RankedPlace {
    double mean_px, rank;
    std::uint32_t number, place;
  };
  static bool is_better(const RankedPlace& a, const RankedPlace& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.number < b.number;
  }

  std::vector<ScoredTemplate> best_of_region(const TemplateScan& scan, std::size_t region,
                                             std::size_t most) const {
    const auto better = [](const auto& a, const auto& b) { return is_better(a, b); };
    const auto hits =
        std::span<const TemplateHit>(hits_).subspan(region * scan.templates(), scan.templates());
    std::vector<RankedPlace> best;  // a heap, the worst in front
    for (std::uint32_t place = 0; place < hits.size(); ++place) {
      if (hits[place].sum == TEMPLATE_SCAN_NONE) continue;
      const RankedPlace ranked =
          ranked_place(scan, scan.number(region, place), place, hits[place].sum);
      if (best.size() == most && is_better(best.front(), ranked)) continue;
      if (admitted_ && !admitted_->admits(scored_template(ranked, hits))) continue;
      if (best.size() == most) {
        std::ranges::pop_heap(best, better);
        best.pop_back();
      }
      best.push_back(ranked);
      std::ranges::push_heap(best, better);
    }
    std::ranges::sort_heap(best, better);
    std::vector<ScoredTemplate> scored;
    scored.reserve(best.size());
    for (const RankedPlace& ranked : best) scored.push_back(scored_template(ranked, hits));
    return scored;
  }

  // ScanRegion by region.
  std::vector<ScanHit> hits_of(const Ranked& ranked) const {
    std::vector<std::size_t> first{0};
    for (const std::vector<ScoredTemplate>& in_region : ranked)
      first.push_back(first.back() + in_region.size());
    std::vector<ScanHit> hits(first.back());
    backend_.threads().for_each(ranked.size(), [&](std::size_t region) {
      std::ranges::transform(ranked[region], hits.begin() + std::ptrdiff_t(first[region]),
                             [&](const ScoredTemplate& scored) { return scale_.hit_of(scored); });
    });
    return hits;
  }

  RankedPlace ranked_place(const TemplateScan& scan, std::uint32_t number, std::uint32_t place,
                           std::uint32_t sum) const {
    const double mean_px = double(sum) / (4.0 * scan.points_of(number).count);
    return {mean_px, mean_px * size_weights_[number % std::uint32_t(size_weights_.size())], number,
            place};
  }

  // `hits` of the region.
  static ScoredTemplate scored_template(const RankedPlace& ranked,
                                        std::span<const TemplateHit> hits) {
    const TemplateHit& hit = hits[ranked.place];
    return {ranked.number, Eigen::Vector2d(hit.x, hit.y), ranked.mean_px, ranked.rank};
  }

  // By region; as many of each, filled up with none.
  static std::vector<std::uint32_t> numbers_of(const Ranked& ranked) {
    std::size_t most = 0;
    for (const std::vector<ScoredTemplate>& in_region : ranked)
      most = std::max(most, in_region.size());
    std::vector<std::uint32_t> numbers(ranked.size() * most, TEMPLATE_SCAN_NONE);
    for (std::size_t region = 0; region < ranked.size(); ++region)
      for (std::size_t i = 0; i < ranked[region].size(); ++i)
        numbers[region * most + i] = std::uint32_t(ranked[region][i].number);
    return numbers;
  }

  const SearchedScale& scale_;
  const AdmittedSearch* admitted_;
  Backend& backend_;
  const ScanOptions& options_;
  Unfilled<TemplateHit>& hits_;  // of the last scan and, behind them, of longer ones
  std::vector<float> distances_m_;
  std::vector<double> size_weights_;      // by distance
  std::vector<Eigen::Vector2d> middles_;  // of the regions, coarse px
  std::vector<TemplateRegion> regions_;
  std::vector<TemplateAnchors> anchors_;  // [region][distance]
  std::vector<Pose> turned_;              // [region][turn]
};

// The regions that are scanned between two looks at the limit: without one, all.
std::vector<std::span<const ScanRegion>> parts_between_checks(std::span<const ScanRegion> regions,
                                                              const TimeLimit* limit) {
  constexpr std::size_t most = 2;  // some tenth of a second on two cores
  const std::size_t of_part =
      limit && limit->is_set() ? most : std::max<std::size_t>(1, regions.size());
  std::vector<std::span<const ScanRegion>> parts;
  for (std::size_t first = 0; first < regions.size(); first += of_part)
    parts.push_back(regions.subspan(first, std::min(of_part, regions.size() - first)));
  return parts;
}

}  // namespace

Se3 place_template(const TemplateSet& set, const TemplateView& view, double in_plane_rad,
                   double distance_m, const Eigen::Vector2d& pixel, const Camera& camera) {
  const Eigen::Vector3d ray = ray_through(camera, pixel).normalized();
  const Eigen::Quaterniond towards_ray =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ray);
  const Eigen::Quaterniond rotation = towards_ray *
                                      Eigen::AngleAxisd(in_plane_rad, Eigen::Vector3d::UnitZ()) *
                                      view.camera_from_object;
  return {rotation.normalized(), distance_m * ray - rotation * set.model.center_m};
}

std::size_t level_of_scale(const TemplateSet& set, int scale, const ObjectView& view) {
  const double distance_m = distance_scales(set.options)[std::size_t(scale)].middle_m();
  return level_for(size_px(set.model.mesh.diameter_m, distance_m, view.camera), view);
}

std::vector<ScanHit> coarse_scan(const TemplateSet& set, const ObjectView& view, Backend& backend,
                                 const ScanOptions& options, const TimeLimit* limit) {
  check(options.points >= 4 && options.points <= int(TEMPLATE_SCORE_MAX_POINTS),
        "coarse_scan: points of a template");
  check(options.quick_points >= 1 && options.quick_kept >= 1, "coarse_scan: first pass");
  const int scales = int(distance_scales(set.options).size());
  const std::size_t of_scale = share_of_scale(std::size_t(options.num_kept), set);
  Unfilled<TemplateHit> of_templates;
  std::vector<ScanHit> hits;
  for (int scale = 0; scale < scales; ++scale) {
    const SearchedScale searched(set, scale, view);
    const std::vector<ScanRegion> regions = cut_into_regions(view, searched.level, options);
    std::optional<AdmittedSearch> admitted;
    if (options.world.is_given() || view.depth) admitted.emplace(searched, view, options);
    const double share = admitted ? admitted->share() : 1;
    const auto of_admitted = std::size_t(std::ceil(double(of_scale) * share));
    const std::size_t most = (of_admitted + regions.size() - 1) / regions.size();
    for (const std::span<const ScanRegion> part : parts_between_checks(regions, limit)) {
      if (limit && limit->is_over()) return hits;
      std::vector<ScanHit> of_part = RegionScan(searched, admitted ? &*admitted : nullptr, part,
                                                backend, options, of_templates)
                                         .best(most);
      if (hits.empty())
        hits = std::move(of_part);
      else
        hits.insert(hits.end(), of_part.begin(), of_part.end());
    }
  }
  return hits;
}

double scan_mean_px(const TemplateSet& set, const ObjectView& view, const Se3& camera_from_object,
                    Backend& backend, const ScanOptions& options) {
  const ReducedTensors& level = view.reduced[level_of_pose(view, set.model, camera_from_object)];
  const ThinnedView visible(
      {camera_from_object.rotation, visible_edges(set.model, {&camera_from_object, 1}, backend)[0]},
      options.points);
  std::vector<TemplatePoint> points(std::size_t(visible.count()));
  const bool is_drawn = visible.project(
      to_pose(camera_from_object),
      {level.salient->intrinsics, level.salient->shape.bins, nearest_drawn_m(set)}, points.data());
  if (!is_drawn || points.empty()) return TEMPLATE_SCORE_CAP / 4.0;
  const TemplateJob job{0, std::uint32_t(points.size()), 0, 0, 1, 1};
  TemplateHit hit;
  backend.template_score(*level.salient, points, {&job, 1}, options.anchor_step, {&hit, 1});
  return double(hit.sum) / (4.0 * job.point_count);
}

}  // namespace edgescout
