#include <cmath>

#include "kernels/error.h"
#include "kernels/pose_normal_equations.h"
#include "kernels/template_project.h"

namespace edgescout {

namespace {

constexpr float min_nearest_m = 1e-6f;
constexpr float max_px = 1e6f;

// False for what is not a number, too.
bool within(float value, float bound) { return std::abs(value) <= bound; }

bool is_in_range(float value) { return within(value, float(POSE_MAX_RANGE_M)); }

void check_options(const TemplateProjectOptions& options) {
  const Intrinsics& k = options.intrinsics;
  check(k.fx > 0 && k.fy > 0 && within(k.fx, max_px) && within(k.fy, max_px),
        "template_project: focal length");
  check(within(k.cx, max_px) && within(k.cy, max_px), "template_project: principal point");
  check(options.bins >= 1 && options.bins <= 0xffff, "template_project: bins");
  check(options.nearest_m >= min_nearest_m && is_in_range(options.nearest_m),
        "template_project: nearest depth");
}

}  // namespace

ModelPointPlanes::ModelPointPlanes(std::span<const ModelPoint> points)
    : count_(static_cast<std::uint32_t>(points.size())) {
  values_.reserve(TEMPLATE_PROJECT_PLANES * points.size());
  for (float ModelPoint::*coordinate : {&ModelPoint::x_m, &ModelPoint::y_m, &ModelPoint::z_m,
                                        &ModelPoint::tx, &ModelPoint::ty, &ModelPoint::tz})
    for (const ModelPoint& point : points) values_.push_back(point.*coordinate);
}

void check_template_points(std::span<const ModelPoint> points) {
  for (const ModelPoint& p : points)
    for (const float value : {p.x_m, p.y_m, p.z_m, p.tx, p.ty, p.tz})
      check(is_in_range(value), "template_project: a model point that is nowhere");
}

void check_template_project(std::uint32_t points, std::span<const TemplateProjectJob> jobs,
                            const TemplateProjectOptions& options, std::size_t projected,
                            std::size_t too_near) {
  check_options(options);
  check(too_near == jobs.size(), "template_project: as many counts as jobs");
  std::size_t free_place = 0;
  for (const TemplateProjectJob& job : jobs) {
    for (const float value : job.camera_from_object.m)
      check(is_in_range(value), "template_project: a pose that is nowhere");
    check(within(job.anchor_x_px, max_px) && within(job.anchor_y_px, max_px),
          "template_project: anchor");
    check(job.point_count <= TEMPLATE_SCORE_MAX_POINTS, "template_project: points of a template");
    check(std::size_t(job.first_point) + job.point_count <= points,
          "template_project: points beyond the list");
    check(job.first_projected >= free_place, "template_project: places that do not ascend");
    free_place = std::size_t(job.first_projected) + job.point_count;
    check(free_place <= projected, "template_project: places beyond the list");
  }
}

}  // namespace edgescout
