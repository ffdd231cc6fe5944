#include "host/detect/coarse_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "host/core/thinned.h"
#include "host/detect/search_space.h"
#include "host/detect/template_projection.h"
#include "host/register/coarse_registration.h"
#include "host/register/thresholds.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// Points nearer to the camera are not drawn.
float nearest_m(const TemplateSet& set) { return float(0.1 * set.model.radius_m); }

// The parameters of a template by its number. Numbers run over viewpoints, in-plane turns and
// distances; the distance changes fastest.
struct TemplateNumbering {
  std::size_t viewpoints;
  int in_plane_steps;
  std::vector<double> distances_m;

  std::size_t count() const { return viewpoints * in_plane_steps * distances_m.size(); }
  int viewpoint(std::size_t t) const { return int(t / (in_plane_steps * distances_m.size())); }
  double in_plane_rad(std::size_t t) const {
    return 2 * std::numbers::pi / in_plane_steps * double(t / distances_m.size() % in_plane_steps);
  }
  double distance_m(std::size_t t) const { return distances_m[t % distances_m.size()]; }
};

// Anchors of one row or column of the grid: from `begin` on, before `end`.
struct AnchorRange {
  int begin, end;
};

// The anchors of a coarse image between two places of the full image; at least one.
AnchorRange anchors_between(double from_px, double to_px, double reduction, int coarse_px,
                            int step) {
  const auto anchor_at = [&](double px) { return ((px + 0.5) / reduction - 0.5) / step; };
  const int count = (coarse_px + step - 1) / step,
            begin = std::min(int(std::ceil(anchor_at(from_px))), count - 1);
  return {begin, int(std::clamp(std::ceil(anchor_at(to_px)), double(begin + 1), double(count)))};
}

struct Region {
  int x0, y0, columns, rows;  // first anchor, coarse px, and numbers of anchors
  Eigen::Vector2d middle;     // coarse px
};

Region region_at(AnchorRange across, AnchorRange down, int step) {
  Region region{
      across.begin * step, down.begin * step, across.end - across.begin, down.end - down.begin, {}};
  region.middle = {std::round(region.x0 + 0.5 * step * (region.columns - 1)),
                   std::round(region.y0 + 0.5 * step * (region.rows - 1))};
  return region;
}

std::vector<Region> cut_into_regions(const ObjectView& view, const ReducedTensors& level,
                                     const ScanOptions& options) {
  const ImageRegion& within = options.within;
  if (within.x >= view.camera.width || within.y >= view.camera.height)
    throw InputError(
        "options", "detect.region", fmt::format("a corner at {}, {}", within.x, within.y),
        fmt::format("one in an image of {}x{}", view.camera.width, view.camera.height));
  const int step = options.anchor_step;
  const auto end_px = [](double from_px, double size_px) {
    return size_px > 0 ? from_px + size_px : INFINITY;
  };
  const AnchorRange across = anchors_between(within.x, end_px(within.x, within.width),
                                             level.reduction, level.camera.width, step),
                    down = anchors_between(within.y, end_px(within.y, within.height),
                                           level.reduction, level.camera.height, step);
  std::vector<Region> regions;
  for (int r = down.begin; r < down.end; r += options.region_rows)
    for (int c = across.begin; c < across.end; c += options.region_columns)
      regions.push_back(region_at({c, std::min(c + options.region_columns, across.end)},
                                  {r, std::min(r + options.region_rows, down.end)}, step));
  return regions;
}

// A template at its best anchor of a region.
struct ScoredTemplate {
  std::size_t number;
  Eigen::Vector2d anchor_px;
  double mean_px, rank;
  auto key() const { return std::pair(rank, number); }
};

// One scale of a template set and the tensors on which it is scanned.
struct SearchedScale {
  const TemplateSet& set;
  int index;  // of distance_scales
  const ReducedTensors& level;
  TemplateNumbering numbering;

  SearchedScale(const TemplateSet& templates, int scale, const ObjectView& view)
      : set(templates),
        index(scale),
        level(view.reduced[level_of_scale(templates, scale, view)]),
        numbering{
            set.views.size(), set.options.in_plane_steps,
            template_distances_m(set.options, distance_scales(set.options)[std::size_t(scale)])} {}

  Se3 camera_from_object(std::size_t number, const Eigen::Vector2d& anchor_px) const {
    return place_template(set, set.views[std::size_t(numbering.viewpoint(number))],
                          numbering.in_plane_rad(number), numbering.distance_m(number), anchor_px,
                          level.camera);
  }

  ScanHit hit_of(const ScoredTemplate& scored) const {
    return {{0, camera_from_object(scored.number, scored.anchor_px)},
            numbering.viewpoint(scored.number),
            index,
            scored.mean_px,
            scored.rank};
  }
};

// What a prior in the world leaves of the search of one scale.
class AdmittedSearch {
 public:
  AdmittedSearch(const SearchedScale& scale, const ObjectView& view, const ScanOptions& options)
      : scale_(scale),
        anchor_step_(options.anchor_step),
        space_(options.world, scale.set.model, view.camera_from_world) {}

  // By distance: the smallest part of a region with all anchors where the object's centre may be.
  std::vector<std::optional<Region>> parts_of(const Region& region) const {
    std::vector<std::optional<Region>> parts;
    for (const double distance_m : scale_.numbering.distances_m)
      parts.push_back(part_at(distance_m, region));
    return parts;
  }

  bool admits(const ScoredTemplate& scored) const {
    return space_.is_everywhere() ||
           space_.admits(scale_.hit_of(scored).pose.world_from_object,
                         slack_at(scale_.numbering.distance_m(scored.number)));
  }

 private:
  std::optional<Region> part_at(double distance_m, const Region& region) const {
    if (space_.is_everywhere()) return region;
    Eigen::AlignedBox2i part;  // column, row
    for (int row = 0; row < region.rows; ++row)
      for (int column = 0; column < region.columns; ++column) {
        const Eigen::Vector2d anchor(region.x0 + anchor_step_ * column,
                                     region.y0 + anchor_step_ * row);
        if (space_.meets(ray_through(scale_.level.camera, anchor).normalized(), distance_m,
                         slack_at(distance_m)))
          part.extend(Eigen::Vector2i(column, row));
      }
    if (part.isEmpty()) return std::nullopt;
    return Region{region.x0 + anchor_step_ * part.min().x(),
                  region.y0 + anchor_step_ * part.min().y(), part.sizes().x() + 1,
                  part.sizes().y() + 1, region.middle};
  }

  // How far beside the pose that it stands for a hit may lie.
  SearchSlack slack_at(double distance_m) const {
    return {anchor_step_ * distance_m / scale_.level.camera.fx +
                thresholds::SAME_POSE * scale_.set.model.mesh.diameter_m,
            scale_.set.options.distance_ratio};
  }

  const SearchedScale& scale_;
  int anchor_step_;
  SearchSpace space_;
};

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
  RegionScan(const SearchedScale& scale, const AdmittedSearch& admitted,
             std::span<const Region> regions, Backend& backend, const ScanOptions& options,
             std::vector<TemplateHit>& hits)
      : scale_(scale), admitted_(admitted), backend_(backend), options_(options), hits_(hits) {
    for (const double distance_m : scale.numbering.distances_m)
      distances_m_.push_back(float(distance_m));
    for (const Region& region : regions) add_region(region);
    turn_templates();
  }

  // Of every region the hits of the lowest ranks, at most `most`, best first.
  std::vector<ScanHit> best(std::size_t most) {
    std::vector<std::uint32_t> all(scale_.numbering.count());
    std::iota(all.begin(), all.end(), 0u);
    const int quick_points = std::min(options_.quick_points, options_.points);
    const Ranked promising =
        best_in_regions(quick_points, all, true, std::size_t(options_.quick_kept) * most);
    return hits_of(best_in_regions(options_.points, numbers_of(promising), false, most));
  }

 private:
  using Ranked = std::vector<std::vector<ScoredTemplate>>;  // by region, best first

  // One that the prior leaves anchors of.
  void add_region(const Region& region) {
    const std::vector<std::optional<Region>> parts = admitted_.parts_of(region);
    if (std::ranges::none_of(parts, &std::optional<Region>::has_value)) return;
    const Eigen::Vector3f ray =
        ray_through(scale_.level.camera, region.middle).normalized().cast<float>();
    middles_.push_back(region.middle);
    regions_.push_back(
        {float(region.middle.x()), float(region.middle.y()), ray.x(), ray.y(), ray.z()});
    for (const std::optional<Region>& part : parts)
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
        {level.salient->intrinsics, level.salient->shape.bins, nearest_m(scale_.set)},
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

  std::vector<ScoredTemplate> best_of_region(const TemplateScan& scan, std::size_t region,
                                             std::size_t most) const {
    std::vector<ScoredTemplate> best;  // a heap, the worst in front
    for (std::size_t place = 0; place < scan.templates(); ++place) {
      const TemplateHit& hit = hits_[region * scan.templates() + place];
      if (hit.sum == TEMPLATE_SCAN_NONE) continue;
      const ScoredTemplate scored = scored_template(scan, scan.number(region, place), hit);
      if (best.size() == most && best.front().key() < scored.key()) continue;
      if (!admitted_.admits(scored)) continue;
      if (best.size() == most) {
        std::ranges::pop_heap(best, {}, &ScoredTemplate::key);
        best.pop_back();
      }
      best.push_back(scored);
      std::ranges::push_heap(best, {}, &ScoredTemplate::key);
    }
    std::ranges::sort_heap(best, {}, &ScoredTemplate::key);
    return best;
  }

  // Region by region.
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

  ScoredTemplate scored_template(const TemplateScan& scan, std::uint32_t number,
                                 const TemplateHit& hit) const {
    const double mean_px = double(hit.sum) / (4.0 * scan.points_of(number).count);
    return {number, Eigen::Vector2d(hit.x, hit.y), mean_px,
            mean_px * scan_size_weight(scale_.numbering.distance_m(number))};
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
  const AdmittedSearch& admitted_;
  Backend& backend_;
  const ScanOptions& options_;
  std::vector<TemplateHit>& hits_;  // of the last scan and, behind them, of longer ones
  std::vector<float> distances_m_;
  std::vector<Eigen::Vector2d> middles_;  // of the regions, coarse px
  std::vector<TemplateRegion> regions_;
  std::vector<TemplateAnchors> anchors_;  // [region][distance]
  std::vector<Pose> turned_;              // [region][turn]
};

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

std::size_t share_of_scale(std::size_t of_one, const TemplateSet& set) {
  const double scales = double(distance_scales(set.options).size());
  return std::size_t(std::ceil(double(of_one) / std::sqrt(scales)));
}

std::vector<ScanHit> coarse_scan(const TemplateSet& set, const ObjectView& view, Backend& backend,
                                 const ScanOptions& options) {
  check(options.points >= 4 && options.points <= int(TEMPLATE_SCORE_MAX_POINTS),
        "coarse_scan: points of a template");
  check(options.quick_points >= 1 && options.quick_kept >= 1, "coarse_scan: first pass");
  const int scales = int(distance_scales(set.options).size());
  const std::size_t of_scale = share_of_scale(std::size_t(options.num_kept), set);
  std::vector<TemplateHit> of_templates;
  std::vector<ScanHit> hits;
  for (int scale = 0; scale < scales; ++scale) {
    const SearchedScale searched(set, scale, view);
    const std::vector<Region> regions = cut_into_regions(view, searched.level, options);
    const std::size_t most = (of_scale + regions.size() - 1) / regions.size();
    const AdmittedSearch admitted(searched, view, options);
    const std::vector<ScanHit> of_scale_hits =
        RegionScan(searched, admitted, regions, backend, options, of_templates).best(most);
    hits.reserve(std::size_t(scales) * of_scale_hits.size());
    hits.insert(hits.end(), of_scale_hits.begin(), of_scale_hits.end());
  }
  return hits;
}

double scan_mean_px(const TemplateSet& set, const ObjectView& view, const Se3& camera_from_object,
                    Backend& backend, const ScanOptions& options) {
  const ReducedTensors& level = view.reduced[level_of_pose(view, set.model, camera_from_object)];
  const ThinnedView visible(
      {camera_from_object.rotation, visible_edges(set.model, {&camera_from_object, 1}, backend)[0]},
      options.points);
  const Eigen::Vector2d anchor_px =
      project(level.camera, camera_from_object * set.model.center_m).array().round();
  std::vector<TemplatePoint> points(std::size_t(visible.count()));
  const bool is_drawn = visible.project(to_pose(camera_from_object), level.salient->intrinsics,
                                        float(anchor_px.x()), float(anchor_px.y()),
                                        level.salient->shape.bins, nearest_m(set), points.data());
  if (!is_drawn || points.empty()) return TEMPLATE_SCORE_CAP / 4.0;
  const TemplateJob job{0, std::uint32_t(points.size()), int(anchor_px.x()), int(anchor_px.y()), 1,
                        1};
  TemplateHit hit;
  backend.template_score(*level.salient, points, {&job, 1}, options.anchor_step, {&hit, 1});
  return double(hit.sum) / (4.0 * job.point_count);
}

}  // namespace edgescout
