#include "host/io/depth_registration.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "host/core/kernel_types.h"
#include "host/core/option_names.h"
#include "host/io/pixel_map.h"
#include "kernels/depth_raster.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr float MOST_RELATIVE_STEP = 0.02f;  // of depth between neighbours on one surface

void require_size(const DepthImage& depth, const Camera& camera) {
  if (depth.width != camera.width || depth.height != camera.height)
    throw InputError("depth image", "size", fmt::format("{}x{}", depth.width, depth.height),
                     fmt::format("{}x{} as its camera has ({} names another one)", camera.width,
                                 camera.height, option_name("depth-camera")));
}

// The triangles between neighbouring pixels of one surface.
class MeasuredSurface {
 public:
  MeasuredSurface(const DepthImage& depth, const Camera& ideal) : depth_(depth) {
    for (int y = 0; y < depth.height; ++y)
      for (int x = 0; x < depth.width; ++x) {
        const Eigen::Vector3d point_m = double(depth.at(x, y)) * ray_through(ideal, {x, y});
        for (const double coordinate : point_m) vertices_m_.push_back(float(coordinate));
      }
    for (int y = 0; y + 1 < depth.height; ++y)
      for (int x = 0; x + 1 < depth.width; ++x) {
        add(number(x, y), number(x + 1, y), number(x, y + 1));
        add(number(x + 1, y), number(x + 1, y + 1), number(x, y + 1));
      }
  }
  TriangleMesh mesh() const { return {vertices_m_, triangles_}; }

 private:
  std::uint32_t number(int x, int y) const {
    return std::uint32_t(y) * std::uint32_t(depth_.width) + std::uint32_t(x);
  }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto [low, high] = std::minmax({depth_.z_m[a], depth_.z_m[b], depth_.z_m[c]});
    if (low > 0 && high - low <= MOST_RELATIVE_STEP * high)
      triangles_.insert(triangles_.end(), {a, b, c});
  }

  const DepthImage& depth_;
  std::vector<float> vertices_m_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

DepthImage undistort_depth(const DepthImage& depth, const Camera& camera) {
  require_size(depth, camera);
  if (!camera.has_distortion()) return depth;
  const cv::Mat source(depth.height, depth.width, CV_32F, const_cast<float*>(depth.z_m.data()));
  const PixelMap map = map_to_original(camera);
  DepthImage result{depth.width, depth.height, std::vector<float>(depth.z_m.size())};
  cv::Mat target(depth.height, depth.width, CV_32F, result.z_m.data());
  cv::remap(source, target, map.x, map.y, cv::INTER_NEAREST, cv::BORDER_CONSTANT,
            cv::Scalar(DEPTH_MISSING));
  return result;
}

DepthImage register_depth(const DepthImage& depth, const DepthCamera& from, const Camera& grey,
                          ThreadPool& pool) {
  const DepthImage ideal_depth = undistort_depth(depth, from.camera);
  const MeasuredSurface surface(ideal_depth, undistorted(from.camera));
  const Camera target = undistorted(grey);
  const DepthJob job{to_pose(from.grey_from_depth), intrinsics_of(target)};
  DepthImage result{target.width, target.height,
                    std::vector<float>(std::size_t(target.width) * std::size_t(target.height))};
  depth_raster_fast(surface.mesh(), {&job, 1}, target.width, target.height, result.z_m, pool);
  for (float& z_m : result.z_m)
    if (!std::isfinite(z_m)) z_m = DEPTH_MISSING;
  return result;
}

DepthImage in_grey_camera(const DepthImage& depth, const std::optional<DepthCamera>& from,
                          const Camera& grey, ThreadPool& pool) {
  return from ? register_depth(depth, *from, grey, pool) : undistort_depth(depth, grey);
}

}  // namespace edgescout
