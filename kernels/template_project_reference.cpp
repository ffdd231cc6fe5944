#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/pose_geometry.h"
#include "kernels/template_project.h"

namespace edgescout {

namespace {

std::int16_t rounded_offset(double px) {
  constexpr double far_px = TEMPLATE_PROJECT_FAR_PX;
  return static_cast<std::int16_t>(std::round(std::clamp(px, -far_px, far_px)));
}

TemplatePoint project_point(const PosedPoint<double>& posed, const TemplateProjectJob& job,
                            const TemplateProjectOptions& options) {
  const ProjectedEdge<double> edge = project_edge(posed, options.intrinsics);
  const double turn = orientation(edge.dx, edge.dy) * options.bins / std::numbers::pi;
  return {rounded_offset(edge.u - job.anchor_x_px), rounded_offset(edge.v - job.anchor_y_px),
          static_cast<std::uint16_t>(int(std::round(turn)) % options.bins)};
}

}  // namespace

void template_project_reference(const ModelPointPlanes& points,
                                std::span<const TemplateProjectJob> jobs,
                                const TemplateProjectOptions& options,
                                std::span<TemplatePoint> projected,
                                std::span<std::uint32_t> too_near) {
  check_template_project(points.count(), jobs, options, projected.size(), too_near.size());
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const TemplateProjectJob& job = jobs[j];
    too_near[j] = 0;
    for (std::uint32_t i = 0; i < job.point_count; ++i) {
      PosedPoint<double> posed =
          pose_point<double>(job.camera_from_object, points.at(job.first_point + i));
      if (posed.point.z < options.nearest_m) {
        ++too_near[j];
        posed.point.z = options.nearest_m;
      }
      projected[job.first_projected + i] = project_point(posed, job, options);
    }
  }
}

}  // namespace edgescout
