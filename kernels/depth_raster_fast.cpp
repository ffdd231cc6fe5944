// The z-buffer, fast: vertices projected once a job, every row of a triangle solved for its span,
// spans filled by a loop the compiler turns into vectors.
#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/depth_raster.h"
#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// Projected vertices, structure of arrays; inverse_z is 0 where a vertex is too near. In double: a
// vertex far outside the image must not move the edge that crosses it.
struct Projected {
  std::vector<double> u, v, inverse_z;
  void resize(std::size_t n) {
    u.resize(n);
    v.resize(n);
    inverse_z.resize(n);
  }
};

EDGESCOUT_SIMD_CLONES
void project_vertices(const DepthJob& job, const float* p, std::size_t count, double* u, double* v,
                      double* inverse_z) {
  const float* m = job.camera_from_object.m;
  const double fx = job.intrinsics.fx, fy = job.intrinsics.fy, cx = job.intrinsics.cx,
               cy = job.intrinsics.cy;
  for (std::size_t i = 0; i < count; ++i) {
    const double px = p[3 * i], py = p[3 * i + 1], pz = p[3 * i + 2];
    const double x = m[0] * px + m[1] * py + m[2] * pz + m[3];
    const double y = m[4] * px + m[5] * py + m[6] * pz + m[7];
    const double z = m[8] * px + m[9] * py + m[10] * pz + m[11];
    const double inverse = z >= DEPTH_NEAR_M ? 1 / z : 0;
    u[i] = fx * x * inverse + cx;
    v[i] = fy * y * inverse + cy;
    inverse_z[i] = inverse;
  }
}

// Rows [y0, y1) of a map.
struct Band {
  float* depth;
  int width, y0, y1;
};

// The half-plane of one edge, solved for x along a row: bound(y) = at_zero + slope * y.
struct EdgeBound {
  double slope, at_zero;
  int side;  // +1: x >= bound; -1: x <= bound; 0: a level edge, inside where bound >= 0
};

[[gnu::always_inline]] inline EdgeBound edge_bound(double ua, double va, double ub, double vb,
                                                   double winding) {
  const double a = winding * (va - vb), b = winding * (ub - ua), c = -a * ua - b * va;
  if (a == 0) return {b, c, 0};
  return {-b / a, -c / a, a > 0 ? 1 : -1};
}

// Narrows [first, last] to the pixels of row y inside the edge.
[[gnu::always_inline]] inline void narrow(const EdgeBound& edge, int y, double& first,
                                          double& last) {
  const double bound = edge.at_zero + edge.slope * y;
  if (edge.side > 0)
    first = std::max(first, std::ceil(bound));
  else if (edge.side < 0)
    last = std::min(last, std::floor(bound));
  else if (bound < 0)
    last = -1;
}

// Lowers depth[0, count) to 1 / (start + i * step). The bounds are those of the triangle's corners:
// on a sliver the plane's slope is rounding noise.
[[gnu::always_inline]] inline void fill_span(float* depth, int count, float start, float step,
                                             float least, float most) {
  for (int i = 0; i < count; ++i) {
    const float inverse_z = std::min(most, std::max(least, start + step * static_cast<float>(i)));
    depth[i] = std::min(depth[i], 1 / inverse_z);
  }
}

[[gnu::always_inline]] inline void draw_triangle(const std::array<double, 3>& u,
                                                 const std::array<double, 3>& v,
                                                 const std::array<double, 3>& w, const Band& band) {
  const double du1 = u[1] - u[0], dv1 = v[1] - v[0], du2 = u[2] - u[0], dv2 = v[2] - v[0];
  const double area = du1 * dv2 - dv1 * du2;
  if (area == 0 || !std::isfinite(area)) return;
  const double winding = area > 0 ? 1 : -1;
  const double top = std::max<double>(band.y0, std::ceil(std::min({v[0], v[1], v[2]})));
  const double bottom = std::min<double>(band.y1 - 1, std::floor(std::max({v[0], v[1], v[2]})));
  const double left = std::max(0.0, std::ceil(std::min({u[0], u[1], u[2]})));
  const double right = std::min(band.width - 1.0, std::floor(std::max({u[0], u[1], u[2]})));
  if (!(top <= bottom && left <= right)) return;
  const EdgeBound edges[] = {edge_bound(u[0], v[0], u[1], v[1], winding),
                             edge_bound(u[1], v[1], u[2], v[2], winding),
                             edge_bound(u[2], v[2], u[0], v[0], winding)};
  // 1/z is affine in the image.
  const double step_x = ((w[1] - w[0]) * dv2 - (w[2] - w[0]) * dv1) / area;
  const double step_y = ((w[2] - w[0]) * du1 - (w[1] - w[0]) * du2) / area;
  const float least = static_cast<float>(std::min({w[0], w[1], w[2]})),
              most = static_cast<float>(std::max({w[0], w[1], w[2]}));
  for (int y = static_cast<int>(top); y <= static_cast<int>(bottom); ++y) {
    double first = left, last = right;
    for (const EdgeBound& edge : edges) narrow(edge, y, first, last);
    if (!(first <= last)) continue;
    const int x = static_cast<int>(first);
    const double start = w[0] + step_x * (x - u[0]) + step_y * (y - v[0]);
    fill_span(band.depth + std::size_t(y) * band.width + x, static_cast<int>(last) - x + 1,
              static_cast<float>(start), static_cast<float>(step_x), least, most);
  }
}

// One clone holds it all: rounding is one instruction there, and a triangle of a fine mesh covers a
// pixel.
EDGESCOUT_SIMD_CLONES
void draw_triangles(const TriangleMesh& mesh, const Projected& at, const Band& band) {
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const std::uint32_t a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
    if (at.inverse_z[a] == 0 || at.inverse_z[b] == 0 || at.inverse_z[c] == 0) continue;
    draw_triangle({at.u[a], at.u[b], at.u[c]}, {at.v[a], at.v[b], at.v[c]},
                  {at.inverse_z[a], at.inverse_z[b], at.inverse_z[c]}, band);
  }
}

void draw_band(const TriangleMesh& mesh, const DepthJob& job, const Band& band) {
  thread_local Projected at;
  const std::size_t vertices = mesh.vertices_m.size() / 3;
  at.resize(vertices);
  project_vertices(job, mesh.vertices_m.data(), vertices, at.u.data(), at.v.data(),
                   at.inverse_z.data());
  std::fill(band.depth + std::size_t(band.y0) * band.width,
            band.depth + std::size_t(band.y1) * band.width, DEPTH_EMPTY);
  draw_triangles(mesh, at, band);
}

}  // namespace

void draw_depth_map(const TriangleMesh& mesh, const DepthJob& job, int width, int height,
                    std::span<float> depth) {
  draw_band(mesh, job, {depth.data(), width, 0, height});
}

void depth_raster_fast(const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width,
                       int height, std::span<float> depth, ThreadPool& pool) {
  check_depth_raster(mesh, jobs.size(), width, height, depth.size());
  // With fewer jobs than threads a map is cut into bands.
  const std::size_t threads = pool.threads();
  const std::size_t bands = jobs.size() >= threads ? 1 : std::min<std::size_t>(height, threads);
  pool.for_each(jobs.size() * bands, [&](std::size_t task) {
    const std::size_t j = task / bands, b = task % bands;
    draw_band(mesh, jobs[j],
              {depth.data() + j * width * height, width, static_cast<int>(height * b / bands),
               static_cast<int>(height * (b + 1) / bands)});
  });
}

}  // namespace edgescout
