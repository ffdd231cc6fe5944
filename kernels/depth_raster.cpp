// The definition, one pixel at a time, in double.
#include "kernels/depth_raster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/error.h"

namespace edgescout {

namespace {

struct Vertex {
  double u, v, inverse_z;
  bool in_front;
};

Vertex project_vertex(const DepthJob& job, const float* p) {
  const float* m = job.camera_from_object.m;
  const double x = m[0] * double(p[0]) + m[1] * double(p[1]) + m[2] * double(p[2]) + m[3];
  const double y = m[4] * double(p[0]) + m[5] * double(p[1]) + m[6] * double(p[2]) + m[7];
  const double z = m[8] * double(p[0]) + m[9] * double(p[1]) + m[10] * double(p[2]) + m[11];
  if (!(z >= DEPTH_NEAR_M)) return {0, 0, 0, false};
  return {job.intrinsics.fx * x / z + job.intrinsics.cx,
          job.intrinsics.fy * y / z + job.intrinsics.cy, 1 / z, true};
}

// Twice the signed area of (a, b, point): >= 0 on one side of the edge a b.
double edge_function(const Vertex& a, const Vertex& b, double x, double y) {
  return (b.u - a.u) * (y - a.v) - (b.v - a.v) * (x - a.u);
}

// The pixels of [0, size) whose centres lie within the bounds of three coordinates.
std::array<int, 2> pixel_range(double a, double b, double c, int size) {
  const double first = std::max(0.0, std::ceil(std::min({a, b, c})));
  const double last = std::min(size - 1.0, std::floor(std::max({a, b, c})));
  if (!(first <= last)) return {0, -1};
  return {static_cast<int>(first), static_cast<int>(last)};
}

void draw_triangle(const std::array<Vertex, 3>& t, int width, int height, float* depth) {
  const double area = edge_function(t[0], t[1], t[2].u, t[2].v);
  if (area == 0 || !std::isfinite(area)) return;
  const auto [x0, x1] = pixel_range(t[0].u, t[1].u, t[2].u, width);
  const auto [y0, y1] = pixel_range(t[0].v, t[1].v, t[2].v, height);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double w0 = edge_function(t[1], t[2], x, y) / area,
                   w1 = edge_function(t[2], t[0], x, y) / area;
      const double w2 = edge_function(t[0], t[1], x, y) / area;
      if (w0 < 0 || w1 < 0 || w2 < 0) continue;
      const double inverse_z = w0 * t[0].inverse_z + w1 * t[1].inverse_z + w2 * t[2].inverse_z;
      float& nearest = depth[std::size_t(y) * width + x];
      nearest = std::min(nearest, static_cast<float>(1 / inverse_z));
    }
}

}  // namespace

void depth_raster_reference(const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width,
                            int height, std::span<float> depth) {
  check_depth_raster(mesh, jobs.size(), width, height, depth.size());
  std::ranges::fill(depth, DEPTH_EMPTY);
  for (std::size_t j = 0; j < jobs.size(); ++j)
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      std::array<Vertex, 3> t;
      for (int k = 0; k < 3; ++k)
        t[k] = project_vertex(jobs[j],
                              mesh.vertices_m.data() + std::size_t(3) * mesh.triangles[i + k]);
      if (t[0].in_front && t[1].in_front && t[2].in_front)
        draw_triangle(t, width, height, depth.data() + j * width * height);
    }
}

void check_depth_raster(const TriangleMesh& mesh, std::size_t jobs, int width, int height,
                        std::size_t depth_size) {
  check(width > 0 && height > 0, "depth_raster: a map without pixels");
  check(depth_size == jobs * width * height, "depth_raster: output of another size than the maps");
  check(mesh.vertices_m.size() % 3 == 0 && mesh.triangles.size() % 3 == 0,
        "depth_raster: not triples");
  const std::size_t vertices = mesh.vertices_m.size() / 3;
  check(std::ranges::all_of(mesh.triangles, [&](std::uint32_t i) { return i < vertices; }),
        "depth_raster: a triangle names a vertex that is not there");
}

}  // namespace edgescout
