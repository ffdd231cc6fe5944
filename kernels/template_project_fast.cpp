#include <algorithm>

#include "kernels/simd.h"
#include "kernels/template_project.h"
#include "kernels/thread_pool.h"
#include "kernels/undirected_angle.h"

namespace edgescout {

namespace {

// Half away from zero.
inline int rounded_offset(float px) {
  constexpr float far_px = TEMPLATE_PROJECT_FAR_PX;
  const float near = std::min(std::max(px, -far_px), far_px);
  return static_cast<int>(near + (near < 0 ? -0.5f : 0.5f));
}

// `planes` begin at the job's first point. The numbers wait on the stack as 32 bits each: packing
// them in the same loop would keep it from becoming vectors.
EDGESCOUT_SIMD_CLONES
int project_points(const TemplateProjectJob& job, const TemplateProjectOptions& options,
                   const float* const* planes, TemplatePoint* out) {
  const float* m = job.camera_from_object.m;
  const Intrinsics k = options.intrinsics;
  const int count = int(job.point_count), bins = options.bins;
  const float nearest_m = options.nearest_m, x_px = job.anchor_x_px, y_px = job.anchor_y_px;
  const float *x = planes[0], *y = planes[1], *z = planes[2], *tx = planes[3], *ty = planes[4],
              *tz = planes[5];
  const float bins_per_rad = float(bins) / 3.14159265f;
  int dx[TEMPLATE_SCORE_MAX_POINTS], dy[TEMPLATE_SCORE_MAX_POINTS], bin[TEMPLATE_SCORE_MAX_POINTS];
  int too_near = 0;
  for (int i = 0; i < count; ++i) {
    const float px = m[0] * x[i] + m[1] * y[i] + m[2] * z[i] + m[3],
                py = m[4] * x[i] + m[5] * y[i] + m[6] * z[i] + m[7];
    const float depth_m = m[8] * x[i] + m[9] * y[i] + m[10] * z[i] + m[11];
    const float qx = m[0] * tx[i] + m[1] * ty[i] + m[2] * tz[i],
                qy = m[4] * tx[i] + m[5] * ty[i] + m[6] * tz[i];
    const float qz = m[8] * tx[i] + m[9] * ty[i] + m[10] * tz[i];
    too_near += depth_m < nearest_m ? 1 : 0;
    const float pz = std::max(depth_m, nearest_m);
    const float inverse = 1.0f / pz;
    dx[i] = rounded_offset(k.fx * px * inverse + k.cx - x_px);
    dy[i] = rounded_offset(k.fy * py * inverse + k.cy - y_px);
    const float half_up =
        undirected_angle(k.fx * (pz * qx - px * qz), k.fy * (pz * qy - py * qz)) * bins_per_rad +
        0.5f;
    const int turn = static_cast<int>(half_up);
    bin[i] = turn >= bins ? 0 : turn;
  }
  for (int i = 0; i < count; ++i)
    out[i] = {static_cast<std::int16_t>(dx[i]), static_cast<std::int16_t>(dy[i]),
              static_cast<std::uint16_t>(bin[i])};
  return too_near;
}

}  // namespace

std::uint32_t project_template(const ModelPointPlanes& points, const TemplateProjectJob& job,
                               const TemplateProjectOptions& options, TemplatePoint* out) {
  const float* planes[TEMPLATE_PROJECT_PLANES];
  for (int c = 0; c < int(TEMPLATE_PROJECT_PLANES); ++c)
    planes[c] = points.plane(c) + job.first_point;
  return static_cast<std::uint32_t>(project_points(job, options, planes, out));
}

void template_project_fast(const ModelPointPlanes& points, std::span<const TemplateProjectJob> jobs,
                           const TemplateProjectOptions& options,
                           std::span<TemplatePoint> projected, std::span<std::uint32_t> too_near,
                           ThreadPool& pool) {
  check_template_project(points.count(), jobs, options, projected.size(), too_near.size());
  for_each_in_chunks(pool, jobs.size(), 256, [&](std::size_t j) {
    too_near[j] =
        project_template(points, jobs[j], options, projected.data() + jobs[j].first_projected);
  });
}

}  // namespace edgescout
