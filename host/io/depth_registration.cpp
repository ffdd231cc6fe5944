#include "host/io/depth_registration.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "host/core/depth_surface.h"
#include "host/core/kernel_types.h"
#include "host/core/option_names.h"
#include "host/io/pixel_map.h"
#include "kernels/depth_raster.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr float MOST_RELATIVE_STEP = 0.02f;  // of depth between neighbours on one surface

void require_size_of_camera(const DepthImage& depth, const Camera& camera) {
  if (depth.width != camera.width || depth.height != camera.height)
    throw InputError("depth image", "size", fmt::format("{}x{}", depth.width, depth.height),
                     fmt::format("{}x{} as its camera has ({} names another one)", camera.width,
                                 camera.height, option_name("depth-camera")));
}

}  // namespace

DepthImage undistort_depth(const DepthImage& depth, const Camera& camera) {
  require_size_of_camera(depth, camera);
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
  DepthSurface surface;
  surface.add(ideal_depth, undistorted(from.camera), Se3{}, MOST_RELATIVE_STEP);
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
