#include "host/core/depth_surface.h"

#include <algorithm>

namespace edgescout {

void DepthSurface::add(const DepthImage& depth, const Camera& camera, const Se3& frame_from_camera,
                       float largest_step) {
  const auto first = std::uint32_t(vertices_m_.size() / 3);
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) {
      const Eigen::Vector3d point_m =
          frame_from_camera * (double(depth.at(x, y)) * ray_through(camera, {x, y}));
      for (const double coordinate : point_m) vertices_m_.push_back(float(coordinate));
    }
  const auto number = [&](int x, int y) {
    return std::uint32_t(y) * std::uint32_t(depth.width) + std::uint32_t(x);
  };
  const auto connect = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto [low, high] = std::minmax({depth.z_m[a], depth.z_m[b], depth.z_m[c]});
    if (low > 0 && high - low <= largest_step * high)
      triangles_.insert(triangles_.end(), {first + a, first + b, first + c});
  };
  for (int y = 0; y + 1 < depth.height; ++y)
    for (int x = 0; x + 1 < depth.width; ++x) {
      connect(number(x, y), number(x + 1, y), number(x, y + 1));
      connect(number(x + 1, y), number(x + 1, y + 1), number(x, y + 1));
    }
}

}  // namespace edgescout
