#include "host/detect/coarse_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/detect/template_projection.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// A template's parameters by its number: viewpoints, in-plane steps and distances, the last
// fastest.
struct Numbering {
  int steps;
  std::vector<double> distances;
  int view(std::size_t t) const { return int(t / (steps * distances.size())); }
  double in_plane_rad(std::size_t t) const {
    return 2 * std::numbers::pi / steps * double(t / distances.size() % steps);
  }
  double distance_m(std::size_t t) const { return distances[t % distances.size()]; }
};

// Anchors in a row or column: those from `begin` on, before `end`.
struct Anchors {
  int begin, end;
};

// Those of a coarse image that lie between two places of the full one; at least one.
Anchors anchors_between(double from_px, double to_px, double reduction, int coarse_px, int step) {
  const auto place = [&](double px) { return ((px + 0.5) / reduction - 0.5) / step; };
  const int all = (coarse_px + step - 1) / step,
            begin = std::min(int(std::ceil(place(from_px))), all - 1);
  return {begin, int(std::clamp(std::ceil(place(to_px)), double(begin + 1), double(all)))};
}

struct Region {
  int x0, y0, columns, rows;  // first anchor and numbers of anchors
  Eigen::Vector2d middle;
};

std::vector<Region> cut_into_regions(const Observation& observation, const ScanOptions& options) {
  const Camera &full = observation.view.camera, &camera = observation.coarse_camera;
  const ImageRegion& within = options.within;
  if (within.x >= full.width || within.y >= full.height)
    throw InputError("options", "detect.region",
                     fmt::format("a corner at {}, {}", within.x, within.y),
                     fmt::format("one in an image of {}x{}", full.width, full.height));
  const int step = options.anchor_step;
  const auto end_px = [](double from_px, double size_px) {
    return size_px > 0 ? from_px + size_px : INFINITY;
  };
  const Anchors across = anchors_between(within.x, end_px(within.x, within.width),
                                         observation.reduction, camera.width, step),
                down = anchors_between(within.y, end_px(within.y, within.height),
                                       observation.reduction, camera.height, step);
  std::vector<Region> regions;
  for (int r = down.begin; r < down.end; r += options.region_rows)
    for (int c = across.begin; c < across.end; c += options.region_columns) {
      Region region{c * step,
                    r * step,
                    std::min(options.region_columns, across.end - c),
                    std::min(options.region_rows, down.end - r),
                    {}};
      region.middle = {std::round(region.x0 + 0.5 * step * (region.columns - 1)),
                       std::round(region.y0 + 0.5 * step * (region.rows - 1))};
      regions.push_back(region);
    }
  return regions;
}

// Shared by all regions of a scan, so that nothing is made anew.
struct Workspace {
  std::vector<ThinnedView> views;
  std::vector<TemplatePoint> points;
  std::vector<TemplateJob> jobs;
  std::vector<TemplateHit> hits;
  std::vector<char> drawn;  // not where a point would lie behind the camera
};

void scan_region(const TemplateSet& set, const Numbering& numbering, const Region& region,
                 const Observation& observation, Backend& backend, const ScanOptions& options,
                 std::size_t most, Workspace& work, std::vector<ScanHit>& found) {
  const std::size_t templates = set.views.size() * numbering.steps * numbering.distances.size();
  work.points.resize(templates * options.points);
  work.jobs.resize(templates);
  work.hits.resize(templates);
  work.drawn.resize(templates);
  const auto& salient = *observation.salient;
  const float nearest_m = float(0.1 * set.model.radius_m);
  constexpr std::size_t chunk = 256;
  backend.threads().for_each((templates + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t t = c * chunk; t < std::min(templates, (c + 1) * chunk); ++t) {
      const Se3 pose =
          place_template(set, set.views[numbering.view(t)], numbering.in_plane_rad(t),
                         numbering.distance_m(t), region.middle, observation.coarse_camera);
      const ThinnedView& view = work.views[numbering.view(t)];
      TemplatePoint* points = work.points.data() + t * options.points;
      int count = view.count();
      work.drawn[t] = count > 0 &&
                      view.project(to_pose(pose), salient.intrinsics, float(region.middle.x()),
                                   float(region.middle.y()), salient.shape.bins, nearest_m, points);
      if (!work.drawn[t]) points[0] = {}, count = 1;  // a job needs a point; its answer is not read
      work.jobs[t] = {static_cast<std::uint32_t>(t * options.points),
                      static_cast<std::uint32_t>(count),
                      region.x0,
                      region.y0,
                      static_cast<std::uint32_t>(region.columns),
                      static_cast<std::uint32_t>(region.rows)};
    }
  });
  backend.template_score(*observation.salient, work.points, work.jobs, options.anchor_step,
                         work.hits);
  const auto mean = [&](std::size_t t) {
    return double(work.hits[t].sum) / (4.0 * work.jobs[t].point_count);
  };
  std::vector<double> weights;  // by distance
  for (const double distance_m : numbering.distances)
    weights.push_back(scan_size_weight(distance_m));
  const auto rank = [&](std::size_t t) { return mean(t) * weights[t % weights.size()]; };
  std::vector<std::size_t> order;
  for (std::size_t t = 0; t < templates; ++t)
    if (work.drawn[t]) order.push_back(t);
  const std::size_t kept = std::min(most, order.size());
  std::partial_sort(order.begin(), order.begin() + kept, order.end(),
                    [&](std::size_t a, std::size_t b) {
                      const double ra = rank(a), rb = rank(b);
                      return ra != rb ? ra < rb : a < b;
                    });
  for (std::size_t i = 0; i < kept; ++i) {
    const std::size_t t = order[i];
    const Eigen::Vector2d anchor(work.hits[t].x, work.hits[t].y);
    found.push_back({numbering.view(t),
                     place_template(set, set.views[numbering.view(t)], numbering.in_plane_rad(t),
                                    numbering.distance_m(t), anchor, observation.coarse_camera),
                     mean(t), rank(t)});
  }
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

std::vector<ScanHit> coarse_scan(const TemplateSet& set, const Observation& observation,
                                 Backend& backend, const ScanOptions& options) {
  check(options.points >= 4 && options.points <= int(TEMPLATE_SCORE_MAX_POINTS),
        "coarse_scan: points of a template");
  const Numbering numbering{set.options.in_plane_steps, template_distances_m(set.options)};
  std::vector<ScanHit> found;
  Workspace work;
  for (const TemplateView& view : set.views) work.views.emplace_back(view, options.points);
  const std::vector<Region> regions = cut_into_regions(observation, options);
  const std::size_t share = (options.kept + regions.size() - 1) / regions.size();
  for (const Region& region : regions)
    scan_region(set, numbering, region, observation, backend, options, share, work, found);
  return found;
}

void scan_for(std::span<const TemplateSet> sets, Observation& observation, Backend& backend,
              const ScanOptions& options) {
  if (!observation.hits.empty()) return;
  for (const TemplateSet& set : sets)
    observation.hits.push_back(
        std::make_shared<std::vector<ScanHit>>(coarse_scan(set, observation, backend, options)));
}

}  // namespace edgescout
