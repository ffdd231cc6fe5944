// The same sums on the CPU, fast: points in groups of 16 lanes, arithmetic in loops the compiler
// turns into vectors, only the depths read one by one; problems spread over the threads.
#include <algorithm>
#include <cmath>

#include "kernels/pose_depth.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int depth_lanes = 16;
struct DepthLanes {
  float v[depth_lanes];
  float& operator[](int i) { return v[i]; }
  const float& operator[](int i) const { return v[i]; }
};

// Places in the list of sums.
enum DepthSum {
  depth_gradient = 21,
  depth_cost = 27,
  depth_weight,
  depth_offset,
  depth_agreeing,
  depth_contradicting,
  depth_hidden,
  depth_missing,
  depth_sums
};

// `counted` is 1 or 0. What does not count has finite numbers all the same.
struct DepthGroup {
  DepthLanes counted, arm[3], point[3], normal[3];  // arm: from the object's origin
  DepthLanes column, row, depth;                    // of the nearest pixel; depth 0: missing
};

inline __attribute__((always_inline)) void load_samples(const SurfacePoint* samples, int count,
                                                        const Pose& pose, DepthGroup& g) {
  DepthLanes m[6];
  for (int i = 0; i < depth_lanes; ++i) {
    const SurfacePoint& s = samples[std::min(i, count - 1)];
    m[0][i] = s.x_m, m[1][i] = s.y_m, m[2][i] = s.z_m, m[3][i] = s.nx, m[4][i] = s.ny,
    m[5][i] = s.nz;
  }
  for (int r = 0; r < 3; ++r) {
    const float* row = pose.m + 4 * r;
    for (int i = 0; i < depth_lanes; ++i) {
      g.arm[r][i] = row[0] * m[0][i] + row[1] * m[1][i] + row[2] * m[2][i];
      g.point[r][i] = g.arm[r][i] + row[3];
      g.normal[r][i] = row[0] * m[3][i] + row[1] * m[4][i] + row[2] * m[5][i];
    }
  }
  for (int i = 0; i < depth_lanes; ++i) {
    constexpr float range = float(POSE_MAX_RANGE_M);
    const float x = g.point[0][i], y = g.point[1][i], z = g.point[2][i];
    const float facing = g.normal[0][i] * x + g.normal[1][i] * y + g.normal[2][i] * z;
    const bool seen = z > POSE_MIN_DEPTH_M && z < range && std::abs(x) < range &&
                      std::abs(y) < range &&
                      facing <= -MIN_FACING * std::sqrt(x * x + y * y + z * z) && i < count;
    g.counted[i] = seen ? 1.0f : 0.0f;
    for (int r = 0; r < 3; ++r) {
      g.arm[r][i] = seen ? g.arm[r][i] : 1.0f;
      g.point[r][i] = seen ? g.point[r][i] : 1.0f;
      g.normal[r][i] = seen ? g.normal[r][i] : -1.0f;
    }
  }
}

inline __attribute__((always_inline)) void read_depths(const DepthView& view, DepthGroup& g) {
  const Intrinsics& k = view.intrinsics;
  const float width = float(view.width), height = float(view.height);
  int pixel[depth_lanes];
  DepthLanes inside;
  for (int i = 0; i < depth_lanes; ++i) {
    const float inverse = 1.0f / g.point[2][i];
    const float u = k.fx * g.point[0][i] * inverse + k.cx + 0.5f,
                v = k.fy * g.point[1][i] * inverse + k.cy + 0.5f;
    inside[i] = u >= 0 && u < width && v >= 0 && v < height ? 1.0f : 0.0f;
    // In this order a NaN becomes 0.
    const int x = int(std::min(std::max(0.0f, u), width - 1)),
              y = int(std::min(std::max(0.0f, v), height - 1));
    pixel[i] = y * view.width + x;
    g.column[i] = float(x), g.row[i] = float(y);
  }
  for (int i = 0; i < depth_lanes; ++i) g.depth[i] = view.z_m[std::size_t(pixel[i])];
  for (int i = 0; i < depth_lanes; ++i) {
    const bool measured = g.depth[i] > 0 && g.depth[i] < float(POSE_MAX_RANGE_M);
    g.depth[i] = measured && inside[i] > 0 ? g.depth[i] : 0.0f;
  }
}

struct DepthTerms {
  DepthLanes r, weight, jacobian[6];
};

// Residuals with their derivatives, and all sums that are no matrix.
inline __attribute__((always_inline)) void compare(const DepthGroup& g, const Intrinsics& k,
                                                   const PoseDepthOptions& options,
                                                   DepthLanes* sums, DepthTerms& t) {
  const float surface2 = options.surface_m * options.surface_m;
  for (int i = 0; i < depth_lanes; ++i) {
    const float ray_x = (g.column[i] - k.cx) / k.fx, ray_y = (g.row[i] - k.cy) / k.fy;
    const float nx = g.normal[0][i], ny = g.normal[1][i], nz = g.normal[2][i], d = g.depth[i];
    const float towards = nx * ray_x + ny * ray_y + nz;
    // Verdicts are 1 or 0: the compiler leaves loops with conditions of conditions.
    const float compared = d > 0 && towards < 0 ? g.counted[i] : 0.0f;
    const float slope = compared > 0 ? towards : -1.0f;
    const float to_x = d * ray_x - g.point[0][i], to_y = d * ray_y - g.point[1][i],
                to_z = d - g.point[2][i];  // q - p
    const float along = nx * to_x + ny * to_y + nz * to_z;
    const float offset = along / slope;
    const float sigma = std::max(options.noise_floor_m, options.noise_per_m * d * d);
    const float band = std::max(options.band_m, BAND_SIGMAS * sigma);
    const float hidden = offset < -band ? compared : 0.0f, beyond = offset > band ? compared : 0.0f,
                used = compared - hidden;
    const float s = std::sqrt(sigma * slope * (sigma * slope) + surface2), inverse = 1.0f / s;
    const float r = used * along * inverse, scaled = r / options.loss_scale;
    const float q = 1.0f / (1.0f + scaled * scaled), weight = used * q * q;
    t.r[i] = r;
    t.weight[i] = weight;
    const float ax = to_x + g.arm[0][i], ay = to_y + g.arm[1][i], az = to_z + g.arm[2][i];
    t.jacobian[0][i] = -nx * inverse;
    t.jacobian[1][i] = -ny * inverse;
    t.jacobian[2][i] = -nz * inverse;
    t.jacobian[3][i] = (az * ny - ay * nz) * inverse;
    t.jacobian[4][i] = (ax * nz - az * nx) * inverse;
    t.jacobian[5][i] = (ay * nx - ax * ny) * inverse;
    sums[depth_cost][i] += 0.5f * q * r * r;
    sums[depth_weight][i] += weight;
    sums[depth_offset][i] += weight * offset;
    sums[depth_agreeing][i] += used - beyond;
    sums[depth_contradicting][i] += beyond;
    sums[depth_hidden][i] += hidden;
    sums[depth_missing][i] += g.counted[i] - compared;
  }
}

inline __attribute__((always_inline)) void add_systems(const DepthTerms& t, DepthLanes* sums) {
  int entry = 0;
  for (int a = 0; a < 6; ++a) {
    DepthLanes weighted;
    for (int i = 0; i < depth_lanes; ++i) weighted[i] = t.weight[i] * t.jacobian[a][i];
    for (int b = a; b < 6; ++b, ++entry)
      for (int i = 0; i < depth_lanes; ++i) sums[entry][i] += weighted[i] * t.jacobian[b][i];
    for (int i = 0; i < depth_lanes; ++i) sums[depth_gradient + a][i] += weighted[i] * t.r[i];
  }
}

EDGESCOUT_SIMD_CLONES
void sum_depths(const DepthView& view, std::span<const SurfacePoint> samples, const Pose& pose,
                const PoseDepthOptions& options, float* totals) {
  DepthLanes sums[depth_sums] = {};
  for (std::size_t first = 0; first < samples.size(); first += depth_lanes) {
    DepthGroup group;
    DepthTerms terms;
    const int count = static_cast<int>(std::min<std::size_t>(depth_lanes, samples.size() - first));
    load_samples(samples.data() + first, count, pose, group);
    read_depths(view, group);
    compare(group, view.intrinsics, options, sums, terms);
    add_systems(terms, sums);
  }
  for (int e = 0; e < depth_sums; ++e) {
    totals[e] = 0;
    for (int i = 0; i < depth_lanes; ++i) totals[e] += sums[e][i];
  }
}

}  // namespace

void pose_depth_fast(std::span<const DepthView> views, std::span<const SurfacePoint> points,
                     std::span<const PoseProblem> problems, const PoseDepthOptions& options,
                     std::span<PoseDepth> out, ThreadPool& pool) {
  check_pose_depth(views.size(), points.size(), problems, options, out.size());
  for (const DepthView& view : views) check_depth_view(view);
  pool.for_each(problems.size(), [&](std::size_t i) {
    const PoseProblem& problem = problems[i];
    float totals[depth_sums];
    sum_depths(views[problem.view], points.subspan(problem.first_point, problem.point_count),
               problem.camera_from_object, options, totals);
    PoseDepth& sum = out[i];
    std::copy(totals, totals + depth_gradient, sum.hessian);
    std::copy(totals + depth_gradient, totals + depth_cost, sum.gradient);
    sum.cost = totals[depth_cost];
    sum.weight_sum = totals[depth_weight];
    sum.offset_m = totals[depth_offset];
    sum.agreeing = totals[depth_agreeing];
    sum.contradicting = totals[depth_contradicting];
    sum.hidden = totals[depth_hidden];
    sum.missing = totals[depth_missing];
  });
}

}  // namespace edgescout
