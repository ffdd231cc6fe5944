#include "host/bridge/ros2/depth_for_image.h"

#include "host/bridge/ros2/depth_message.h"
#include "host/io/camera_file.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

constexpr char depth_topic[] = "depth", depth_info[] = "depth camera_info";

std::shared_ptr<const MeasuredDepth> of_same_camera(const DepthImage& stored, const Camera& camera,
                                                    const DepthNoise& noise,
                                                    const std::string& source) {
  if (stored.width != camera.width || stored.height != camera.height)
    throw InputError(source, "size",
                     std::to_string(stored.width) + "x" + std::to_string(stored.height),
                     std::to_string(camera.width) + "x" + std::to_string(camera.height) +
                         " as its image has (depth: own_camera takes another one)");
  return std::make_shared<const MeasuredDepth>(
      MeasuredDepth{undistort_depth(stored, camera), noise});
}

}  // namespace

void DepthForImage::add(const msg::CameraInfo& info) {
  const std::scoped_lock lock(mutex_);
  infos_.add(info);
}

std::shared_ptr<const MeasuredDepth> DepthForImage::of_topic(const msg::Image& depth,
                                                             const msg::Header& image,
                                                             const Camera& camera,
                                                             ThreadPool& pool) const {
  const DepthImage stored = depth_of(depth, options_.depth_values, depth_topic);
  const DepthNoise& noise = options_.depth_values.noise;
  if (options_.depth == DepthSource::Aligned)
    return of_same_camera(stored, camera, noise, depth_topic);
  return std::make_shared<const MeasuredDepth>(MeasuredDepth{
      register_depth(stored, own_camera(depth.header, image, stored), camera, pool), noise});
}

std::shared_ptr<const MeasuredDepth> DepthForImage::of_request(const msg::Image& depth,
                                                               const Camera& camera,
                                                               const std::string& source) const {
  if (depth.width == 0 && depth.height == 0 && depth.data.empty()) return nullptr;
  return of_same_camera(depth_of(depth, options_.depth_values, source), camera,
                        options_.depth_values.noise, source);
}

DepthCamera DepthForImage::own_camera(const msg::Header& depth, const msg::Header& image,
                                      const DepthImage& stored) const {
  Camera camera;
  {
    const std::scoped_lock lock(mutex_);
    if (infos_.empty())
      throw InputError(depth_info, "messages", "none", "one of the depth camera before");
    camera = camera_of(*infos_.for_image(depth), false, depth_info);
  }
  camera = camera_for_image(camera, stored.width, stored.height, false, depth_info);
  if (depth.frame_id == image.frame_id) return {camera, {}};
  return {camera, tf_.lookup(image.frame_id, depth.frame_id, image.stamp, options_.tf_seconds)};
}

}  // namespace edgescout::ros2
