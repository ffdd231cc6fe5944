#include "host/render/depth_borders.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace edgescout {
namespace {

constexpr double JUMP =
    0.005;  // of the depth: what lies so far off a surface's plane is another one

// The depth beyond the largest jump around a pixel, if there is one. A surface that goes on follows
// its tangent plane.
std::optional<double> depth_beyond(const SensedView& sensed, int x, int y) {
  const int width = sensed.grey.width, height = sensed.grey.height;
  const double reach = sensed.sensor().border_px;
  const int r = static_cast<int>(std::floor(reach));
  const Eigen::Vector3d& eye = sensed.view.world_from_camera.translation_m;
  const SeenSurface& here = sensed.surfaces[static_cast<std::size_t>(y) * width + x];
  const double plane = here.normal.dot(here.point_m - eye);
  double largest = JUMP * here.depth_m;
  std::optional<double> beyond;
  for (int v = std::max(0, y - r); v <= std::min(height - 1, y + r); ++v)
    for (int u = std::max(0, x - r); u <= std::min(width - 1, x + r); ++u) {
      if (std::hypot(u - x, v - y) > reach) continue;
      const SeenSurface& there = sensed.surfaces[static_cast<std::size_t>(v) * width + u];
      if (there.triangle == HORIZON) continue;
      const double towards = here.normal.dot(there.point_m - eye) / there.depth_m;
      const double jump = std::abs(there.depth_m - plane / towards);
      if (jump <= largest) continue;
      largest = jump;
      beyond = there.depth_m;
    }
  return beyond;
}

}  // namespace

void smear_borders(DepthImage& depth, const SensedView& sensed) {
  if (sensed.sensor().border_px < 1) return;
  const Random random = sensed.stream("depth border");
  for (int y = 0; y < depth.height; ++y) {
    Random row = random.split(static_cast<std::uint64_t>(y));
    for (int x = 0; x < depth.width; ++x) {
      float& z_m = depth.z_m[static_cast<std::size_t>(y) * depth.width + x];
      const bool missing = row.uniform() < sensed.sensor().border_missing;
      const double share = row.uniform();
      if (z_m == DEPTH_MISSING) continue;
      if (const std::optional<double> beyond = depth_beyond(sensed, x, y))
        z_m = missing ? DEPTH_MISSING : static_cast<float>(z_m + share * (*beyond - z_m));
    }
  }
}

}  // namespace edgescout
