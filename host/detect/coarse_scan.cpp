#include "host/detect/coarse_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

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

// The templates of a scale at the middle of a region. Those of one viewpoint and turn share their
// rotation at every distance.
class TurnedTemplates {
 public:
  TurnedTemplates(const SearchedScale& scale, const Region& region, ThreadPool& pool)
      : numbering_(scale.numbering),
        ray_(ray_through(scale.level.camera, region.middle).normalized()),
        turned_(numbering_.count() / numbering_.distances_m.size()) {
    constexpr std::size_t chunk = 64;
    pool.for_each((turned_.size() + chunk - 1) / chunk, [&](std::size_t c) {
      for (std::size_t i = c * chunk; i < std::min(turned_.size(), (c + 1) * chunk); ++i) {
        const std::size_t number = i * numbering_.distances_m.size();
        const Se3 at_camera =
            place_template(scale.set, scale.set.views[std::size_t(numbering_.viewpoint(number))],
                           numbering_.in_plane_rad(number), 0, region.middle, scale.level.camera);
        turned_[i] = {to_pose(at_camera), at_camera.translation_m};
      }
    });
  }

  Pose camera_from_object(std::size_t number) const {
    const Turned& turned = turned_[number / numbering_.distances_m.size()];
    const Eigen::Vector3d translation_m =
        numbering_.distance_m(number) * ray_ + turned.translation_m;
    Pose pose = turned.at_camera;
    for (int i = 0; i < 3; ++i) pose.m[4 * i + 3] = float(translation_m[i]);
    return pose;
  }

 private:
  struct Turned {  // with the object's centre at the camera
    Pose at_camera;
    Eigen::Vector3d translation_m;
  };
  const TemplateNumbering& numbering_;
  Eigen::Vector3d ray_;
  std::vector<Turned> turned_;
};

// Scores templates in one region after the other with the same buffers.
class TemplateScoring {
 public:
  // With at most `points` of each template.
  TemplateScoring(const SearchedScale& scale, const AdmittedSearch& admitted, int points,
                  Backend& backend, int anchor_step)
      : scale_(scale),
        admitted_(admitted),
        points_of_one_(points),
        anchor_step_(anchor_step),
        backend_(backend) {
    for (const TemplateView& viewpoint : scale.set.views) views_.emplace_back(viewpoint, points);
  }

  // Of the templates of these numbers, at most `most` that are admitted, lowest rank first.
  // `turned` is of the region, `parts` is what is searched of it, by distance.
  std::vector<ScoredTemplate> best(const Region& region, const TurnedTemplates& turned,
                                   std::span<const std::optional<Region>> parts,
                                   std::span<const std::size_t> numbers, std::size_t most) {
    draw(region, turned, parts, numbers);
    best_anchors_.resize(numbers.size());
    backend_.template_score(*scale_.level.salient, points_, jobs_, anchor_step_, best_anchors_);
    std::vector<ScoredTemplate> best;  // a heap, the worst in front
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (!is_drawn_[i]) continue;
      const ScoredTemplate scored = scored_template(i, numbers[i]);
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

 private:
  void draw(const Region& region, const TurnedTemplates& turned,
            std::span<const std::optional<Region>> parts, std::span<const std::size_t> numbers) {
    points_.resize(numbers.size() * points_of_one_);
    jobs_.resize(numbers.size());
    is_drawn_.resize(numbers.size());
    constexpr std::size_t chunk = 256;
    backend_.threads().for_each((numbers.size() + chunk - 1) / chunk, [&](std::size_t c) {
      for (std::size_t i = c * chunk; i < std::min(numbers.size(), (c + 1) * chunk); ++i)
        draw_template(i, numbers[i], region, turned.camera_from_object(numbers[i]),
                      parts[numbers[i] % parts.size()]);
    });
  }

  void draw_template(std::size_t i, std::size_t number, const Region& region,
                     const Pose& camera_from_object, const std::optional<Region>& part) {
    const ThinnedView& view = views_[scale_.numbering.viewpoint(number)];
    const auto& salient = *scale_.level.salient;
    const std::size_t first = i * points_of_one_;
    int count = view.count();
    is_drawn_[i] = part && count > 0 &&
                   view.project(camera_from_object, salient.intrinsics, float(region.middle.x()),
                                float(region.middle.y()), salient.shape.bins, nearest_m(scale_.set),
                                points_.data() + first);
    if (!is_drawn_[i]) points_[first] = {}, count = 1;  // a job needs a point; nobody reads the sum
    const Region anchors = part.value_or(Region{region.x0, region.y0, 1, 1, region.middle});
    jobs_[i] = {std::uint32_t(first), std::uint32_t(count),           anchors.x0,
                anchors.y0,           std::uint32_t(anchors.columns), std::uint32_t(anchors.rows)};
  }

  ScoredTemplate scored_template(std::size_t i, std::size_t number) const {
    const TemplateHit& best = best_anchors_[i];
    const double mean_px = double(best.sum) / (4.0 * jobs_[i].point_count);
    return {number, Eigen::Vector2d(best.x, best.y), mean_px,
            mean_px * scan_size_weight(scale_.numbering.distance_m(number))};
  }

  const SearchedScale& scale_;
  const AdmittedSearch& admitted_;
  std::size_t points_of_one_;
  int anchor_step_;
  Backend& backend_;
  std::vector<ThinnedView> views_;  // by viewpoint
  // By place in the numbers of the last call:
  std::vector<TemplatePoint> points_;  // points_of_one_ of each
  std::vector<TemplateJob> jobs_;
  std::vector<TemplateHit> best_anchors_;
  std::vector<char> is_drawn_;  // false where a point would lie behind the camera
};

// Scans the regions of one scale: all templates with few points, the best of them with all.
class RegionScan {
 public:
  RegionScan(const SearchedScale& scale, const AdmittedSearch& admitted, Backend& backend,
             const ScanOptions& options)
      : scale_(scale),
        admitted_(admitted),
        quick_(scale, admitted, std::min(options.quick_points, options.points), backend,
               options.anchor_step),
        full_(scale, admitted, options.points, backend, options.anchor_step),
        quick_kept_(std::size_t(options.quick_kept)),
        pool_(backend.threads()),
        all_(scale.numbering.count()) {
    std::iota(all_.begin(), all_.end(), 0);
  }

  void append_best(const Region& region, std::size_t most, std::vector<ScanHit>& hits) {
    const std::vector<std::optional<Region>> parts = admitted_.parts_of(region);
    if (std::ranges::none_of(parts, &std::optional<Region>::has_value)) return;
    const TurnedTemplates turned(scale_, region, pool_);
    std::vector<std::size_t> numbers;
    for (const ScoredTemplate& scored :
         quick_.best(region, turned, parts, all_, quick_kept_ * most))
      numbers.push_back(scored.number);
    for (const ScoredTemplate& scored : full_.best(region, turned, parts, numbers, most))
      hits.push_back(scale_.hit_of(scored));
  }

 private:
  const SearchedScale& scale_;
  const AdmittedSearch& admitted_;
  TemplateScoring quick_, full_;
  std::size_t quick_kept_;  // for each hit that is kept
  ThreadPool& pool_;
  std::vector<std::size_t> all_;
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
  std::vector<ScanHit> hits;
  for (int scale = 0; scale < scales; ++scale) {
    const SearchedScale searched(set, scale, view);
    const std::vector<Region> regions = cut_into_regions(view, searched.level, options);
    const std::size_t most = (of_scale + regions.size() - 1) / regions.size();
    const AdmittedSearch admitted(searched, view, options);
    RegionScan scan(searched, admitted, backend, options);
    for (const Region& region : regions) scan.append_best(region, most, hits);
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
