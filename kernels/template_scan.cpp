#include "kernels/template_scan.h"

#include <algorithm>
#include <cmath>

#include "kernels/error.h"
#include "kernels/pose_normal_equations.h"
#include "kernels/thread_pool.h"
#include "kernels/unfilled.h"

namespace edgescout {

namespace {

constexpr TemplateHit no_hit{TEMPLATE_SCAN_NONE, 0, 0};

TemplateJob job_of(const TemplateScan& scan, std::size_t region, std::uint32_t number,
                   std::uint32_t first_point) {
  const TemplateAnchors& anchors = scan.anchors_of(region, number);
  return {first_point, scan.points_of(number).count, anchors.x0, anchors.y0, anchors.columns,
          anchors.rows};
}

void check_anchors(const TemplateAnchors& anchors) {
  if (anchors.columns == 0) return;
  const std::uint64_t count = std::uint64_t(anchors.columns) * anchors.rows;
  check(count >= 1 && count <= TEMPLATE_SCORE_MAX_ANCHORS, "template_scan: anchors of a region");
}

// The templates of one region after the other with the same buffers.
class FastScan {
 public:
  FastScan(std::span<const std::uint16_t> tensor, const TensorShape& shape,
           const ModelPointPlanes& points, const TemplateScan& scan, ThreadPool& pool)
      : tensor_(tensor),
        shape_(shape),
        model_points_(points),
        scan_(scan),
        pool_(pool),
        points_of_one_(std::ranges::max(scan.viewpoints, {}, &ViewpointPoints::count).count),
        points_(scan.templates() * points_of_one_),
        jobs_(scan.templates()),
        is_drawn_(scan.templates()) {}

  void score(std::size_t region, std::span<TemplateHit> hits) {
    for_each_in_chunks(pool_, jobs_.size(), 256, [&](std::size_t i) { draw(region, i); });
    template_score_fast(tensor_, shape_, points_, jobs_, scan_.anchor_step, hits, pool_);
    for (std::size_t i = 0; i < hits.size(); ++i)
      if (!is_drawn_[i]) hits[i] = no_hit;
  }

 private:
  void draw(std::size_t region, std::size_t place) {
    const std::uint32_t number = scan_.number(region, place),
                        first = static_cast<std::uint32_t>(place * points_of_one_);
    is_drawn_[place] = scan_.has(region, number) &&
                       project_template(model_points_, scan_.projection(region, number, first),
                                        scan_.project, points_.data() + first) == 0;
    if (is_drawn_[place]) {
      jobs_[place] = job_of(scan_, region, number, first);
    } else {  // a job needs a point; nobody reads the sum
      points_[first] = {};
      jobs_[place] = {first, 1, 0, 0, 1, 1};
    }
  }

  std::span<const std::uint16_t> tensor_;
  const TensorShape& shape_;
  const ModelPointPlanes& model_points_;
  const TemplateScan& scan_;
  ThreadPool& pool_;
  std::size_t points_of_one_;
  Unfilled<TemplatePoint> points_;  // points_of_one_ of each template
  Unfilled<TemplateJob> jobs_;
  std::vector<char> is_drawn_;
};

}  // namespace

bool TemplateScan::has(std::size_t region, std::uint32_t number) const {
  return number != TEMPLATE_SCAN_NONE && points_of(number).count > 0 &&
         anchors_of(region, number).columns > 0;
}

TemplateProjectJob TemplateScan::projection(std::size_t region, std::uint32_t number,
                                            std::uint32_t first_projected) const {
  const std::size_t turn = number / distances_m.size();
  const TemplateRegion& at = regions[region];
  const float distance_m = distances_m[number % distances_m.size()];
  Pose pose = turned[region * turns() + turn];
  pose.m[3] += distance_m * at.ray_x;
  pose.m[7] += distance_m * at.ray_y;
  pose.m[11] += distance_m * at.ray_z;
  const ViewpointPoints& points = points_of(number);
  return {pose, points.first, points.count, first_projected, at.middle_x_px, at.middle_y_px};
}

void check_template_scan(std::uint32_t points, const TemplateScan& scan, std::size_t hits) {
  check(scan.in_plane_steps >= 1 && !scan.viewpoints.empty() && !scan.distances_m.empty(),
        "template_scan: no templates");
  check(scan.turned.size() == scan.regions.size() * scan.turns(), "template_scan: turned poses");
  check(scan.anchors.size() == scan.regions.size() * scan.distances_m.size(),
        "template_scan: anchors");
  check(scan.same_numbers || scan.regions.empty() || scan.numbers.size() % scan.regions.size() == 0,
        "template_scan: numbers");
  check(hits == scan.hits(), "template_scan: as many hits as templates in regions");
  check(scan.anchor_step >= 1 && scan.anchor_step <= 16, "template_scan: anchor step in [1, 16]");
  for (const ViewpointPoints& of_one : scan.viewpoints) {
    const TemplateProjectJob job{
        scan.turned.empty() ? Pose{} : scan.turned[0], of_one.first, of_one.count, 0, 0, 0};
    check_template_project(points, {&job, 1}, scan.project, TEMPLATE_SCORE_MAX_POINTS, 1);
  }
  // Their sums are in the range that template_project demands.
  constexpr float range = float(POSE_MAX_RANGE_M) / 2;
  for (const Pose& pose : scan.turned)
    check(std::ranges::all_of(pose.m, [](float v) { return std::abs(v) <= range; }),
          "template_scan: a pose that is nowhere");
  for (const float distance_m : scan.distances_m)
    check(std::abs(distance_m) <= range, "template_scan: a distance that is nowhere");
  for (const TemplateRegion& region : scan.regions) {
    const TemplateProjectJob job{{}, 0, 0, 0, region.middle_x_px, region.middle_y_px};
    check_template_project(points, {&job, 1}, scan.project, 0, 1);
    for (const float component : {region.ray_x, region.ray_y, region.ray_z})
      check(std::abs(component) <= 1.001f, "template_scan: a ray longer than 1");
  }
  std::ranges::for_each(scan.anchors, check_anchors);
  const std::size_t count = scan.turns() * scan.distances_m.size();
  for (const std::uint32_t number : scan.numbers)
    check(number < count || number == TEMPLATE_SCAN_NONE, "template_scan: no such template");
}

RegionJobs region_jobs(const TemplateScan& scan, std::size_t region) {
  RegionJobs out;
  for (std::uint32_t place = 0; place < scan.templates(); ++place) {
    const std::uint32_t number = scan.number(region, place);
    if (!scan.has(region, number)) continue;
    const auto first = static_cast<std::uint32_t>(out.point_count);
    out.places.push_back(place);
    out.projections.push_back(scan.projection(region, number, first));
    out.jobs.push_back(job_of(scan, region, number, first));
    out.point_count += out.jobs.back().point_count;
  }
  return out;
}

void place_hits(const RegionJobs& jobs, std::span<const std::uint32_t> too_near,
                std::span<const TemplateHit> of_jobs, std::span<TemplateHit> hits) {
  std::ranges::fill(hits, no_hit);
  for (std::size_t i = 0; i < jobs.places.size(); ++i)
    if (too_near[i] == 0) hits[jobs.places[i]] = of_jobs[i];
}

void template_scan_reference(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                             const ModelPointPlanes& points, const TemplateScan& scan,
                             std::span<TemplateHit> hits) {
  check_template_scan(points.count(), scan, hits.size());
  scan_by_parts(
      scan, hits,
      [&](const RegionJobs& jobs, auto projected, auto too_near) {
        template_project_reference(points, jobs.projections, scan.project, projected, too_near);
      },
      [&](const RegionJobs& jobs, auto projected, auto of_jobs) {
        template_score_reference(tensor, shape, projected, jobs.jobs, scan.anchor_step, of_jobs);
      });
}

void template_scan_fast(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                        const ModelPointPlanes& points, const TemplateScan& scan,
                        std::span<TemplateHit> hits, ThreadPool& pool) {
  check_template_scan(points.count(), scan, hits.size());
  if (hits.empty()) return;
  FastScan fast(tensor, shape, points, scan, pool);
  for (std::size_t region = 0; region < scan.regions.size(); ++region)
    fast.score(region, hits.subspan(region * scan.templates(), scan.templates()));
}

}  // namespace edgescout
