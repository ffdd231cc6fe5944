// Projects the points of many templates into an image, as template_score reads them (paper, Eq. 1).
//
// A job is the points of one viewpoint under one pose. Let (x, y, z) be a point in the camera frame
// and q its unit tangent there. A point nearer than nearest_m gets z = nearest_m. Then
//   dx  = round(fx x / z + cx - anchor_x), half away from zero, clamped to +-FAR_PX; dy alike
//   d   = (fx (z q_x - x q_z), fy (z q_y - y q_z)) = z^2 d(projection)(q)
//   bin = round((atan2(d_y, d_x) mod pi) bins / pi) mod bins
// Eq. 1's pair (o, o') is the point and its neighbour along q, in the limit of a short segment. The
// clamp keeps anchor + dx in range in template_score; a point that far off is outside anyway.
//
// Each job also counts its points with z < nearest_m before the change. Their dx, dy and bin are
// valid for template_score but wrong. A scan must therefore leave out a job with such points.
//
// Model points are planes [6][count] of float: x, y, z (m), then the unit tangent's x, y, z. So the
// CPU reads them in vectors, and neighbouring lanes of a device read neighbouring words. All jobs
// write into one list of TemplatePoint. Their places ascend and do not overlap. What lies between
// two places is not changed.
//
// Agreement: the reference works in double, the fast path and Vulkan in float. Let
// reach = |model point| + |translation|, f = max(fx, fy), s = max(|x|, |y|) / z. A float operation
// errs by 2^-24, a device's division by 2.5 ULP; at most four follow each other. So float keeps
//   a depth to                            1e-6 reach                                   m
//   a position before it is rounded to    1e-6 (f reach / z (1 + s) + |c| + |anchor|)  px
//   an orientation before it is rounded   2e-6 (1 + f reach / |d|)                     rad
// Results differ only where the exact value lies this close to the border between two integers.
// There dx, dy and, circularly, bin differ by one. The bin of an edge seen end on, with |d| near 0,
// is rounding error in float. Counts differ by the points this close to nearest_m.
//
// Device: one workgroup a job; its invocations share the points. Buffers: 0 planes (float), 1 jobs
// (TemplateProjectJob), 2 projected points (TemplatePoint), 3 counts of points too near (uint, one
// a job).
#ifndef EDGESCOUT_TEMPLATE_PROJECT_H
#define EDGESCOUT_TEMPLATE_PROJECT_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(TEMPLATE_PROJECT_GROUP, 64);
EDGESCOUT_CONST(TEMPLATE_PROJECT_FAR_PX, 16000);
EDGESCOUT_CONST(TEMPLATE_PROJECT_PLANES, 6);
EDGESCOUT_CONST(TEMPLATE_PROJECT_JOB_WORDS, 17);

struct TemplateProjectPush {
  float fx;
  float fy;
  float cx;
  float cy;
  float nearest_m;
  uint bins;
  uint point_count;  // of a plane
  uint job_count;
};
#ifdef __cplusplus
}  // namespace edgescout

#include <span>
#include <vector>

#include "kernels/template_score.h"
#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

// Model points plane by plane.
class ModelPointPlanes {
 public:
  explicit ModelPointPlanes(std::span<const ModelPoint> points);
  std::uint32_t count() const { return count_; }
  // 0 to 2: x, y, z; 3 to 5: the tangent's.
  const float* plane(int coordinate) const {
    return values_.data() + std::size_t(coordinate) * count_;
  }
  ModelPoint at(std::size_t i) const {
    return {plane(0)[i], plane(1)[i], plane(2)[i], plane(3)[i], plane(4)[i], plane(5)[i]};
  }
  std::span<const float> values() const { return values_; }

 private:
  std::uint32_t count_;
  std::vector<float> values_;
};

struct TemplateProjectJob {
  Pose camera_from_object;
  std::uint32_t first_point;      // into the planes
  std::uint32_t point_count;      // 0..TEMPLATE_SCORE_MAX_POINTS
  std::uint32_t first_projected;  // place of its first TemplatePoint
  float anchor_x_px, anchor_y_px;
};

struct TemplateProjectOptions {
  Intrinsics intrinsics;
  int bins;         // orientations over pi, 1 to 65535
  float nearest_m;  // 1e-6 to POSE_MAX_RANGE_M
};

// The bounds below keep float from overflow and NaN, which a device may assume never to see.
// LogicError: a coordinate beyond POSE_MAX_RANGE_M, or not finite.
void check_template_points(std::span<const ModelPoint> points);
// LogicError: options out of bounds, a focal length that is not positive, lengths in px above 1e6;
// numbers of a pose beyond POSE_MAX_RANGE_M or not finite; points or places beyond their lists;
// places that do not ascend; not one count a job.
void check_template_project(std::uint32_t points, std::span<const TemplateProjectJob> jobs,
                            const TemplateProjectOptions& options, std::size_t projected,
                            std::size_t too_near);

// `too_near`: for every job, how many of its points lie nearer than nearest_m.
void template_project_reference(const ModelPointPlanes& points,
                                std::span<const TemplateProjectJob> jobs,
                                const TemplateProjectOptions& options,
                                std::span<TemplatePoint> projected,
                                std::span<std::uint32_t> too_near);
void template_project_fast(const ModelPointPlanes& points, std::span<const TemplateProjectJob> jobs,
                           const TemplateProjectOptions& options,
                           std::span<TemplatePoint> projected, std::span<std::uint32_t> too_near,
                           ThreadPool& pool);

// The fast path for one job, on the calling thread and without checks: for host code that uses the
// points of a job at once. Writes to out[0..point_count), not to the job's place. Returns the count
// of points too near.
std::uint32_t project_template(const ModelPointPlanes& points, const TemplateProjectJob& job,
                               const TemplateProjectOptions& options, TemplatePoint* out);

}  // namespace edgescout
#endif
#endif
