#include "host/render/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

constexpr double NEAR_M = 1e-3;

// A projected triangle: three edge functions a x + b y + c >= 0, and 1/z as a plane over the image.
struct ScreenTriangle {
  int index;
  double edge[3][3];
  double inverse_depth[3];
  double x_low, x_high;
  int y_low, y_high;
};

// x, y in px and 1/z; 1/z is 0 for a vertex that is too near.
std::vector<Eigen::Vector3d> project_vertices(const std::vector<Eigen::Vector3d>& vertices_m,
                                              const Camera& camera, const Se3& camera_from_world,
                                              ThreadPool& pool) {
  std::vector<Eigen::Vector3d> projected(vertices_m.size());
  for_each_in_chunks(pool, vertices_m.size(), 4096, [&](std::size_t i) {
    const Eigen::Vector3d x = camera_from_world * vertices_m[i];
    if (x.z() < NEAR_M)
      projected[i].setZero();
    else
      projected[i] << project(camera, x), 1 / x.z();
  });
  return projected;
}

// False: the triangle covers no pixel's centre.
bool set_up(std::array<Eigen::Vector3d, 3> p, const Camera& camera, ScreenTriangle& out) {
  if (p[0].z() == 0 || p[1].z() == 0 || p[2].z() == 0) return false;
  out.x_low = std::min({p[0].x(), p[1].x(), p[2].x()});
  out.x_high = std::max({p[0].x(), p[1].x(), p[2].x()});
  const double y_low = std::min({p[0].y(), p[1].y(), p[2].y()}),
               y_high = std::max({p[0].y(), p[1].y(), p[2].y()});
  if (!(out.x_high >= 0 && out.x_low <= camera.width - 1 && y_high >= 0 &&
        y_low <= camera.height - 1))
    return false;
  // Most triangles of a dense mesh end here.
  if (std::ceil(out.x_low) > out.x_high || std::ceil(y_low) > y_high) return false;
  out.y_low = static_cast<int>(std::max(0.0, std::ceil(y_low)));
  out.y_high = static_cast<int>(std::min(camera.height - 1.0, std::floor(y_high)));
  double area =
      (p[1] - p[0]).head<2>().x() * (p[2] - p[0]).y() - (p[1] - p[0]).y() * (p[2] - p[0]).x();
  if (area < 0) {
    std::swap(p[1], p[2]);
    area = -area;
  }
  if (area < 1e-12) return false;
  std::fill(std::begin(out.inverse_depth), std::end(out.inverse_depth), 0.0);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &from = p[(i + 1) % 3], &to = p[(i + 2) % 3];
    out.edge[i][0] = from.y() - to.y();
    out.edge[i][1] = to.x() - from.x();
    out.edge[i][2] = -(out.edge[i][0] * from.x() + out.edge[i][1] * from.y());
    for (int k = 0; k < 3; ++k) out.inverse_depth[k] += out.edge[i][k] / area * p[i].z();
  }
  return true;
}

void draw_row(const ScreenTriangle& t, int y, Raster& raster) {
  double low = std::max(0.0, t.x_low), high = std::min(raster.width - 1.0, t.x_high);
  for (const auto& [a, b, c] : t.edge) {
    const double rest = b * y + c;
    if (a > 0)
      low = std::max(low, -rest / a);
    else if (a < 0)
      high = std::min(high, -rest / a);
    else if (rest < 0)
      return;
  }
  if (!(low <= high)) return;
  const std::size_t row = static_cast<std::size_t>(y) * raster.width;
  for (int x = static_cast<int>(std::ceil(low)); x <= high; ++x) {
    const auto depth = static_cast<float>(
        1 / (t.inverse_depth[0] * x + t.inverse_depth[1] * y + t.inverse_depth[2]));
    if (depth >= raster.depth_m[row + x]) continue;
    raster.depth_m[row + x] = depth;
    raster.triangle[row + x] = t.index;
  }
}

}  // namespace

void Triangles::add(const Mesh& mesh, const Se3& frame_from_mesh) {
  const int first = static_cast<int>(vertices_m.size());
  for (const Eigen::Vector3d& vertex_m : mesh.vertices_m)
    vertices_m.push_back(frame_from_mesh * vertex_m);
  for (const auto& [a, b, c] : mesh.triangles) corners.push_back({first + a, first + b, first + c});
}

Raster rasterize(const Triangles& in_world, const Camera& camera, const Se3& camera_from_world,
                 ThreadPool& pool) {
  const std::vector<Eigen::Vector3d> projected =
      project_vertices(in_world.vertices_m, camera, camera_from_world, pool);
  std::vector<ScreenTriangle> triangles;
  for (std::size_t i = 0; i < in_world.corners.size(); ++i) {
    const auto& [a, b, c] = in_world.corners[i];
    ScreenTriangle t{};
    t.index = static_cast<int>(i);
    if (set_up({projected[a], projected[b], projected[c]}, camera, t)) triangles.push_back(t);
  }
  Raster raster{camera.width, camera.height, {}, {}};
  const std::size_t size = static_cast<std::size_t>(camera.width) * camera.height;
  raster.depth_m.assign(size, std::numeric_limits<float>::infinity());
  raster.triangle.assign(size, -1);
  // Each thread draws bands of rows. So no two threads write the same pixel, and every pixel gets
  // its triangles in the same order.
  constexpr int BAND = 64;
  pool.for_each((camera.height + BAND - 1) / BAND, [&](std::size_t band) {
    const int first = static_cast<int>(band) * BAND,
              last = std::min(first + BAND, camera.height) - 1;
    for (const ScreenTriangle& t : triangles)
      for (int y = std::max(first, t.y_low); y <= std::min(last, t.y_high); ++y)
        draw_row(t, y, raster);
  });
  return raster;
}

}  // namespace edgescout
