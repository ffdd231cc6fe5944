#include "kernels/point_visibility.h"

#include <algorithm>
#include <vector>

#include "kernels/error.h"
#include "kernels/thread_pool.h"
#include "kernels/unfilled.h"

namespace edgescout {

namespace {

constexpr int max_size = 4096;

// The 3 x 3 pixels of a map around a point's projection; null at the map's border or outside.
const float* middle_of(const float* depth, int size, const Intrinsics& k, const double p[3]) {
  const double u = k.fx * p[0] / p[2] + k.cx + 0.5, v = k.fy * p[1] / p[2] + k.cy + 0.5;
  if (!(u >= 1 && v >= 1 && u < size - 1 && v < size - 1)) return nullptr;
  return depth + std::size_t(v) * std::size_t(size) + std::size_t(u);
}

std::uint8_t flags_of(const float* depth, int size, const VisibilityJob& job, const float* point) {
  const float* m = job.camera_from_object.m;
  double p[3];
  for (int i = 0; i < 3; ++i)
    p[i] = double(m[4 * i]) * point[0] + double(m[4 * i + 1]) * point[1] +
           double(m[4 * i + 2]) * point[2] + double(m[4 * i + 3]);
  if (!(p[2] > 0)) return 0;
  const float* middle = middle_of(depth, size, job.intrinsics, p);
  if (!middle) return POINT_VISIBLE | POINT_BORDERS_BACKGROUND;
  const double nearest_m = p[2] - double(job.tolerance_m);
  float farthest_m = 0;
  for (const float* row : {middle - size, middle, middle + size})
    farthest_m = std::max({farthest_m, row[-1], row[0], row[1]});
  return static_cast<std::uint8_t>((farthest_m >= nearest_m ? POINT_VISIBLE : 0) |
                                   (farthest_m == DEPTH_EMPTY ? POINT_BORDERS_BACKGROUND : 0));
}

void flag_job(const float* depth, int size, const VisibilityPoints& points,
              const VisibilityJob& job, std::uint8_t* flags) {
  const auto add = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i)
      *flags++ = flags_of(depth, size, job, points.points_m.data() + 3 * std::size_t(i));
  };
  add(0, points.shared);
  add(job.first_point, job.point_count);
}

// Where the flags of each job begin.
std::vector<std::size_t> first_flags(const VisibilityPoints& points,
                                     std::span<const VisibilityJob> jobs) {
  std::vector<std::size_t> first;
  std::size_t next = 0;
  for (const VisibilityJob& job : jobs) {
    first.push_back(next);
    next += points.shared + job.point_count;
  }
  return first;
}

}  // namespace

std::size_t flag_count(const VisibilityPoints& points, std::span<const VisibilityJob> jobs) {
  std::size_t count = 0;
  for (const VisibilityJob& job : jobs) count += points.shared + job.point_count;
  return count;
}

void check_point_visibility(const TriangleMesh& mesh, const VisibilityPoints& points,
                            std::span<const VisibilityJob> jobs, int size, std::size_t flags) {
  check(size >= 1 && size <= max_size, "point_visibility: size of a map");
  check_depth_raster(mesh, jobs.size(), size, size, jobs.size() * std::size_t(size) * size);
  const std::size_t count = points.points_m.size() / 3;
  check(points.shared <= count, "point_visibility: shared points beyond the list");
  for (const VisibilityJob& job : jobs) {
    check(std::size_t(job.first_point) + job.point_count <= count,
          "point_visibility: points beyond the list");
    check(job.tolerance_m >= 0, "point_visibility: tolerance");
  }
  check(flags == flag_count(points, jobs), "point_visibility: as many flags as points");
}

void point_visibility_reference(const TriangleMesh& mesh, const VisibilityPoints& points,
                                std::span<const VisibilityJob> jobs, int size,
                                std::span<std::uint8_t> flags) {
  check_point_visibility(mesh, points, jobs, size, flags.size());
  std::vector<float> depth(std::size_t(size) * size);
  const std::vector<std::size_t> first = first_flags(points, jobs);
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const DepthJob drawn{jobs[j].camera_from_object, jobs[j].intrinsics};
    depth_raster_reference(mesh, {&drawn, 1}, size, size, depth);
    flag_job(depth.data(), size, points, jobs[j], flags.data() + first[j]);
  }
}

void point_visibility_fast(const TriangleMesh& mesh, const VisibilityPoints& points,
                           std::span<const VisibilityJob> jobs, int size,
                           std::span<std::uint8_t> flags, ThreadPool& pool) {
  check_point_visibility(mesh, points, jobs, size, flags.size());
  const std::size_t map = std::size_t(size) * size;
  const std::vector<std::size_t> first = first_flags(points, jobs);
  pool.for_each(jobs.size(), [&](std::size_t i) {
    thread_local Unfilled<float> depth;  // looked at while a cache holds it
    if (depth.size() < map) depth.resize(map);
    draw_depth_map(mesh, {jobs[i].camera_from_object, jobs[i].intrinsics}, size, size,
                   std::span(depth).first(map));
    flag_job(depth.data(), size, points, jobs[i], flags.data() + first[i]);
  });
}

}  // namespace edgescout
