#include "host/active/measured_surface.h"

#include <algorithm>
#include <cmath>

#include "host/core/depth_surface.h"
#include "host/core/quantile.h"
#include "host/register/measured_depth.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int BLOCK_PX = 8;    // of the depth image, along both sides, for one measurement
constexpr float STEEPEST = 3;  // change of depth over the distance across the line of sight

// The median of the measured pixels of one block; DEPTH_MISSING where fewer than half are.
float median_of_block(const DepthImage& depth, int x, int y) {
  std::vector<float> values;
  for (int v = y; v < y + BLOCK_PX; ++v)
    for (int u = x; u < x + BLOCK_PX; ++u)
      if (const float z_m = depth.at(u, v); z_m > 0) values.push_back(z_m);
  if (2 * values.size() < std::size_t(BLOCK_PX) * BLOCK_PX) return DEPTH_MISSING;
  return upper_median(values);
}

// One pixel for every block.
DepthImage medians_of_blocks(const DepthImage& depth) {
  DepthImage medians{depth.width / BLOCK_PX, depth.height / BLOCK_PX, {}};
  for (int y = 0; y < medians.height; ++y)
    for (int x = 0; x < medians.width; ++x)
      medians.z_m.push_back(median_of_block(depth, BLOCK_PX * x, BLOCK_PX * y));
  return medians;
}

void add(const ObjectView& view, DepthSurface& surface) {
  const Camera camera = scaled(view.camera, 1.0 / BLOCK_PX);
  surface.add(medians_of_blocks(view.depth->image), camera, inverse(view.camera_from_world),
              STEEPEST / float(std::min(camera.fx, camera.fy)));
}

}  // namespace

bool has_measured_depth(const ObjectView& view) {
  return view.depth &&
         std::ranges::any_of(view.depth->image.z_m, [](float z_m) { return z_m > 0; });
}

std::vector<Occluders> measured_surfaces(std::span<const ObjectView> views, const Camera& camera,
                                         std::span<const Se3> camera_from_world, Backend& backend) {
  if (std::ranges::none_of(views, has_measured_depth)) return {};
  DepthSurface surface;
  for (const ObjectView& view : views)
    if (has_measured_depth(view)) add(view, surface);
  std::vector<DepthJob> jobs;
  for (const Se3& pose : camera_from_world) jobs.push_back({to_pose(pose), intrinsics_of(camera)});
  const std::size_t pixels = std::size_t(camera.width) * std::size_t(camera.height);
  std::vector<float> depth_m(jobs.size() * pixels, DEPTH_EMPTY);
  if (!surface.is_empty())
    backend.depth_raster(surface.mesh(), jobs, camera.width, camera.height, depth_m);
  std::vector<Occluders> seen;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto first = depth_m.begin() + std::ptrdiff_t(i * pixels);
    seen.push_back({camera, {first, first + std::ptrdiff_t(pixels)}});
  }
  return seen;
}

}  // namespace edgescout
