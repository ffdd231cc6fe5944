#include "host/active/measured_surface.h"

#include <algorithm>
#include <cmath>

#include "host/register/measured_depth.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int BLOCK_PX = 8;    // of the depth image, along both sides, for one measurement
constexpr float STEEPEST = 3;  // change of depth over the distance across the line of sight

// The median of the measured pixels of one block; DEPTH_MISSING where fewer than half are.
float median_of_block(const DepthImage& depth, int x, int y, std::vector<float>& values) {
  values.clear();
  for (int v = y; v < y + BLOCK_PX; ++v)
    for (int u = x; u < x + BLOCK_PX; ++u)
      if (const float z_m = depth.at(u, v); z_m > 0) values.push_back(z_m);
  if (2 * values.size() < std::size_t(BLOCK_PX * BLOCK_PX)) return DEPTH_MISSING;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// The measurements of all views as triangles in the world.
class SurfaceMesh {
 public:
  void add(const ObjectView& view) {
    const DepthImage& depth = view.depth->image;
    columns_ = depth.width / BLOCK_PX, rows_ = depth.height / BLOCK_PX;
    steepest_ = STEEPEST * float(BLOCK_PX / std::min(view.camera.fx, view.camera.fy));
    first_ = std::uint32_t(vertices_m_.size() / 3);
    measure(depth);
    const Se3 world_from_camera = inverse(view.camera_from_world);
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        const double middle = 0.5 * (BLOCK_PX - 1);
        const Eigen::Vector3d ray =
            ray_through(view.camera, {BLOCK_PX * x + middle, BLOCK_PX * y + middle});
        const Eigen::Vector3d point_m = world_from_camera * (double(z_m_[number(x, y)]) * ray);
        for (const double coordinate : point_m) vertices_m_.push_back(float(coordinate));
      }
    for (int y = 0; y + 1 < rows_; ++y)
      for (int x = 0; x + 1 < columns_; ++x) {
        connect(number(x, y), number(x + 1, y), number(x, y + 1));
        connect(number(x + 1, y), number(x + 1, y + 1), number(x, y + 1));
      }
  }
  TriangleMesh mesh() const { return {vertices_m_, triangles_}; }

 private:
  std::size_t number(int x, int y) const {
    return std::size_t(y) * std::size_t(columns_) + std::size_t(x);
  }
  void measure(const DepthImage& depth) {
    z_m_.clear();
    std::vector<float> values;
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x)
        z_m_.push_back(median_of_block(depth, BLOCK_PX * x, BLOCK_PX * y, values));
  }
  void connect(std::size_t a, std::size_t b, std::size_t c) {
    const auto [low, high] = std::minmax({z_m_[a], z_m_[b], z_m_[c]});
    if (low > 0 && high - low <= steepest_ * high)
      for (const std::size_t corner : {a, b, c})
        triangles_.push_back(first_ + std::uint32_t(corner));
  }

  std::vector<float> vertices_m_;
  std::vector<std::uint32_t> triangles_;
  // Of the view that is added.
  std::vector<float> z_m_;
  int columns_ = 0, rows_ = 0;
  float steepest_ = 0;
  std::uint32_t first_ = 0;
};

}  // namespace

bool has_measured_depth(const ObjectView& view) {
  return view.depth &&
         std::ranges::any_of(view.depth->image.z_m, [](float z_m) { return z_m > 0; });
}

std::vector<Occluders> measured_surfaces(std::span<const ObjectView> views, const Camera& camera,
                                         std::span<const Se3> camera_from_world, Backend& backend) {
  SurfaceMesh surface;
  for (const ObjectView& view : views)
    if (has_measured_depth(view)) surface.add(view);
  if (surface.mesh().vertices_m.empty()) return {};
  std::vector<DepthJob> jobs;
  for (const Se3& pose : camera_from_world) jobs.push_back({to_pose(pose), intrinsics_of(camera)});
  const std::size_t pixels = std::size_t(camera.width) * std::size_t(camera.height);
  std::vector<float> depth_m(jobs.size() * pixels, DEPTH_EMPTY);
  const TriangleMesh mesh = surface.mesh();
  if (!mesh.triangles.empty())
    backend.depth_raster(mesh, jobs, camera.width, camera.height, depth_m);
  std::vector<Occluders> seen;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto first = depth_m.begin() + std::ptrdiff_t(i * pixels);
    seen.push_back({camera, {first, first + std::ptrdiff_t(pixels)}});
  }
  return seen;
}

}  // namespace edgescout
