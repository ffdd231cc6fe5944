// The header's equations point by point, in double: the judge of the fast path and of the device.
#include <algorithm>
#include <cmath>

#include "kernels/pose_depth.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

using Vector = Vec3<double>;

double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector minus(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

// What was measured where a point is seen.
struct Measured {
  double depth_m = 0;  // 0: nothing
  Vector ray{};
};

Measured measured_at(const DepthView& view, const Vector& point) {
  const Intrinsics& k = view.intrinsics;
  const double x = std::floor(k.fx * point.x / point.z + k.cx + 0.5),
               y = std::floor(k.fy * point.y / point.z + k.cy + 0.5);
  if (!(x >= 0 && x < view.width && y >= 0 && y < view.height)) return {};
  const double depth = view.z_m[std::size_t(y) * std::size_t(view.width) + std::size_t(x)];
  if (!(depth > 0 && depth < POSE_MAX_RANGE_M)) return {};
  return {depth, {(x - k.cx) / k.fx, (y - k.cy) / k.fy, 1}};
}

struct Sums {
  double hessian[21] = {}, gradient[6] = {}, cost = 0, weight = 0, offset = 0;
  int agreeing = 0, contradicting = 0, hidden = 0, missing = 0;

  void add(double r, const double (&jacobian)[6], double offset_m, double loss_scale) {
    const double k2 = loss_scale * loss_scale, q = k2 / (k2 + r * r), w = q * q;
    for (int a = 0, entry = 0; a < 6; ++a) {
      for (int b = a; b < 6; ++b) hessian[entry++] += w * jacobian[a] * jacobian[b];
      gradient[a] += w * r * jacobian[a];
    }
    cost += 0.5 * q * r * r;
    weight += w;
    offset += w * offset_m;
  }
};

void add_point(Sums& sums, const DepthView& view, const Pose& pose, const SurfacePoint& sample,
               const PoseDepthOptions& options) {
  const Vector origin{pose.m[3], pose.m[7], pose.m[11]};
  const Vector arm = rotate<double>(pose, sample.x_m, sample.y_m, sample.z_m);
  const Vector point{arm.x + origin.x, arm.y + origin.y, arm.z + origin.z};
  const Vector normal = rotate<double>(pose, sample.nx, sample.ny, sample.nz);
  if (!can_be_seen(point)) return;
  if (dot(normal, point) > -double(MIN_FACING) * std::sqrt(dot(point, point))) return;
  const Measured measured = measured_at(view, point);
  const double d = measured.depth_m, slope = dot(normal, measured.ray);
  if (d == 0 || slope >= 0) {
    ++sums.missing;
    return;
  }
  const double offset = d - dot(normal, point) / slope;
  const double sigma = std::max(double(options.noise_floor_m), options.noise_per_m * d * d);
  const double band = std::max(double(options.band_m), BAND_SIGMAS * sigma);
  if (offset < -band) {
    ++sums.hidden;
    return;
  }
  ++(offset > band ? sums.contradicting : sums.agreeing);
  const double s = std::hypot(sigma * slope, double(options.surface_m));
  const Vector q{d * measured.ray.x, d * measured.ray.y, d};
  const Vector turn = cross(minus(q, origin), normal);
  const double jacobian[6] = {-normal.x / s, -normal.y / s, -normal.z / s,
                              -turn.x / s,   -turn.y / s,   -turn.z / s};
  sums.add(dot(normal, minus(q, point)) / s, jacobian, offset, options.loss_scale);
}

PoseDepth to_float(const Sums& s) {
  PoseDepth out;
  for (int i = 0; i < 21; ++i) out.hessian[i] = float(s.hessian[i]);
  for (int i = 0; i < 6; ++i) out.gradient[i] = float(s.gradient[i]);
  out.cost = float(s.cost);
  out.weight_sum = float(s.weight);
  out.offset_m = float(s.offset);
  out.agreeing = float(s.agreeing);
  out.contradicting = float(s.contradicting);
  out.hidden = float(s.hidden);
  out.missing = float(s.missing);
  return out;
}

}  // namespace

void pose_depth_reference(std::span<const DepthView> views, std::span<const SurfacePoint> points,
                          std::span<const PoseProblem> problems, const PoseDepthOptions& options,
                          std::span<PoseDepth> out) {
  check_pose_depth(views.size(), points.size(), problems, options, out.size());
  for (const DepthView& view : views) check_depth_view(view);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const PoseProblem& problem = problems[i];
    Sums sums;
    for (const SurfacePoint& point : points.subspan(problem.first_point, problem.point_count))
      add_point(sums, views[problem.view], problem.camera_from_object, point, options);
    out[i] = to_float(sums);
  }
}

}  // namespace edgescout
