#include "host/detect/coarse_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "host/detect/search_space.h"
#include "host/detect/template_projection.h"
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

std::vector<Region> cut_into_regions(const ObjectView& view, const ScanOptions& options) {
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
                                             view.reduction, view.coarse_camera.width, step),
                    down = anchors_between(within.y, end_px(within.y, within.height),
                                           view.reduction, view.coarse_camera.height, step);
  std::vector<Region> regions;
  for (int r = down.begin; r < down.end; r += options.region_rows)
    for (int c = across.begin; c < across.end; c += options.region_columns)
      regions.push_back(region_at({c, std::min(c + options.region_columns, across.end)},
                                  {r, std::min(r + options.region_rows, down.end)}, step));
  return regions;
}

// Scans one region after the other with the same buffers.
class RegionScan {
 public:
  RegionScan(const TemplateSet& set, const ObjectView& view, Backend& backend,
             const ScanOptions& options)
      : set_(set),
        view_(view),
        backend_(backend),
        options_(options),
        space_(options.world, set.model, view.camera_from_world),
        numbering_{set.views.size(), set.options.in_plane_steps, template_distances_m(set.options)},
        points_(numbering_.count() * options.points),
        jobs_(numbering_.count()),
        best_anchors_(numbering_.count()),
        is_drawn_(numbering_.count()) {
    for (const TemplateView& viewpoint : set.views) views_.emplace_back(viewpoint, options.points);
    for (const double distance_m : numbering_.distances_m)
      size_weights_.push_back(scan_size_weight(distance_m));
  }

  void append_best(const Region& region, std::size_t most, std::vector<ScanHit>& hits) {
    parts_.clear();
    for (const double distance_m : numbering_.distances_m)
      parts_.push_back(admitted_part(region, distance_m));
    if (std::ranges::none_of(parts_, &std::optional<Region>::has_value)) return;
    draw_templates(region);
    backend_.template_score(*view_.salient, points_, jobs_, options_.anchor_step, best_anchors_);
    for (const std::size_t t : best_templates(most)) hits.push_back(hit_of(t));
  }

 private:
  // The smallest part with all anchors where the prior admits the object's centre.
  std::optional<Region> admitted_part(const Region& region, double distance_m) const {
    if (space_.is_everywhere()) return region;
    const int step = options_.anchor_step;
    Eigen::AlignedBox2i part;  // column, row
    for (int row = 0; row < region.rows; ++row)
      for (int column = 0; column < region.columns; ++column) {
        const Eigen::Vector2d anchor(region.x0 + step * column, region.y0 + step * row);
        if (space_.meets(ray_through(view_.coarse_camera, anchor).normalized(), distance_m,
                         slack_at(distance_m)))
          part.extend(Eigen::Vector2i(column, row));
      }
    if (part.isEmpty()) return std::nullopt;
    return Region{region.x0 + step * part.min().x(), region.y0 + step * part.min().y(),
                  part.sizes().x() + 1, part.sizes().y() + 1, region.middle};
  }

  // How far beside the pose that it stands for a hit may lie.
  SearchSlack slack_at(double distance_m) const {
    return {options_.anchor_step * distance_m / view_.coarse_camera.fx +
                thresholds::SAME_POSE * set_.model.mesh.diameter_m,
            set_.options.distance_ratio};
  }

  void draw_templates(const Region& region) {
    constexpr std::size_t chunk = 256;
    const std::size_t count = numbering_.count();
    backend_.threads().for_each((count + chunk - 1) / chunk, [&](std::size_t c) {
      for (std::size_t t = c * chunk; t < std::min(count, (c + 1) * chunk); ++t)
        draw_template(t, region);
    });
  }

  void draw_template(std::size_t t, const Region& region) {
    const ThinnedView& view = views_[numbering_.viewpoint(t)];
    TemplatePoint* points = points_.data() + t * options_.points;
    int count = view.count();
    const std::optional<Region>& part = parts_[t % parts_.size()];
    is_drawn_[t] =
        part && count > 0 &&
        view.project(to_pose(camera_from_object(t, region.middle)), view_.salient->intrinsics,
                     float(region.middle.x()), float(region.middle.y()), view_.salient->shape.bins,
                     nearest_m(set_), points);
    if (!is_drawn_[t]) points[0] = {}, count = 1;  // a job needs a point; its answer is not read
    const Region anchors = part.value_or(Region{region.x0, region.y0, 1, 1, region.middle});
    jobs_[t] = {static_cast<std::uint32_t>(t * options_.points),
                static_cast<std::uint32_t>(count),
                anchors.x0,
                anchors.y0,
                static_cast<std::uint32_t>(anchors.columns),
                static_cast<std::uint32_t>(anchors.rows)};
  }

  // Of the templates that were drawn, lowest rank first, those whose hits the prior admits.
  std::vector<std::size_t> best_templates(std::size_t most) const {
    const auto is_worse = [&](std::size_t a, std::size_t b) {
      const double rank_a = rank(a), rank_b = rank(b);
      return rank_a != rank_b ? rank_a > rank_b : a > b;
    };
    std::vector<std::size_t> open;
    for (std::size_t t = 0; t < numbering_.count(); ++t)
      if (is_drawn_[t]) open.push_back(t);
    std::ranges::make_heap(open, is_worse);
    std::vector<std::size_t> best;
    for (; best.size() < most && !open.empty(); open.pop_back()) {
      std::ranges::pop_heap(open, is_worse);
      if (is_admitted(open.back())) best.push_back(open.back());
    }
    return best;
  }

  bool is_admitted(std::size_t t) const {
    return space_.admits(hit_of(t).pose.world_from_object, slack_at(numbering_.distance_m(t)));
  }

  double mean_px(std::size_t t) const {
    return double(best_anchors_[t].sum) / (4.0 * jobs_[t].point_count);
  }
  double rank(std::size_t t) const { return mean_px(t) * size_weights_[t % size_weights_.size()]; }

  ScanHit hit_of(std::size_t t) const {
    const Eigen::Vector2d anchor(best_anchors_[t].x, best_anchors_[t].y);
    return {{0, camera_from_object(t, anchor)}, numbering_.viewpoint(t), mean_px(t), rank(t)};
  }

  Se3 camera_from_object(std::size_t t, const Eigen::Vector2d& coarse_px) const {
    return place_template(set_, set_.views[numbering_.viewpoint(t)], numbering_.in_plane_rad(t),
                          numbering_.distance_m(t), coarse_px, view_.coarse_camera);
  }

  const TemplateSet& set_;
  const ObjectView& view_;
  Backend& backend_;
  const ScanOptions& options_;
  SearchSpace space_;
  TemplateNumbering numbering_;
  std::vector<ThinnedView> views_;            // by viewpoint
  std::vector<double> size_weights_;          // by distance
  std::vector<std::optional<Region>> parts_;  // by distance: what is searched of the region
  // By template:
  std::vector<TemplatePoint> points_;  // ScanOptions::points of each
  std::vector<TemplateJob> jobs_;
  std::vector<TemplateHit> best_anchors_;
  std::vector<char> is_drawn_;  // false where a point would lie behind the camera
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

std::vector<ScanHit> coarse_scan(const TemplateSet& set, const ObjectView& view, Backend& backend,
                                 const ScanOptions& options) {
  check(options.points >= 4 && options.points <= int(TEMPLATE_SCORE_MAX_POINTS),
        "coarse_scan: points of a template");
  const std::vector<Region> regions = cut_into_regions(view, options);
  const std::size_t most = (options.num_kept + regions.size() - 1) / regions.size();
  RegionScan scan(set, view, backend, options);
  std::vector<ScanHit> hits;
  for (const Region& region : regions) scan.append_best(region, most, hits);
  return hits;
}

double scan_mean_px(const TemplateSet& set, const ObjectView& view, const Se3& camera_from_object,
                    Backend& backend, const ScanOptions& options) {
  const ThinnedView visible(
      {camera_from_object.rotation, visible_edges(set.model, {&camera_from_object, 1}, backend)[0]},
      options.points);
  const Eigen::Vector2d anchor_px =
      project(view.coarse_camera, camera_from_object * set.model.center_m).array().round();
  std::vector<TemplatePoint> points(std::size_t(visible.count()));
  const bool is_drawn = visible.project(to_pose(camera_from_object), view.salient->intrinsics,
                                        float(anchor_px.x()), float(anchor_px.y()),
                                        view.salient->shape.bins, nearest_m(set), points.data());
  if (!is_drawn || points.empty()) return TEMPLATE_SCORE_CAP / 4.0;
  const TemplateJob job{0, std::uint32_t(points.size()), int(anchor_px.x()), int(anchor_px.y()), 1,
                        1};
  TemplateHit hit;
  backend.template_score(*view.salient, points, {&job, 1}, options.anchor_step, {&hit, 1});
  return double(hit.sum) / (4.0 * job.point_count);
}

}  // namespace edgescout
