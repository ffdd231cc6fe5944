// Brings depth messages into the cameras of their images.
#pragma once

#include <memory>
#include <mutex>

#include "host/bridge/ros2/bridge_options.h"
#include "host/bridge/ros2/camera_info.h"
#include "host/bridge/ros2/tf_buffer.h"
#include "host/io/depth_registration.h"
#include "host/register/measured_depth.h"

namespace edgescout::ros2 {

class DepthForImage {
 public:
  // Both must outlive this object.
  DepthForImage(const BridgeOptions& options, const TfBuffer& tf) : options_(options), tf_(tf) {}

  // A calibration of the depth camera. Any thread may call.
  void add(const msg::CameraInfo& info);

  // Of the depth topic, for an image of `camera`. InputError: what depth_of (depth_message.h)
  // refuses; a size other than the image's; of a depth camera of its own: no calibration, one of
  // another size, a pose that tf does not know.
  std::shared_ptr<const MeasuredDepth> of_topic(const msg::Image& depth, const msg::Header& image,
                                                const Camera& camera, ThreadPool& pool) const;
  // Of a request, of the same camera; null where the message has no pixels. InputError: as above.
  std::shared_ptr<const MeasuredDepth> of_request(const msg::Image& depth, const Camera& camera,
                                                  const std::string& source) const;

 private:
  DepthCamera own_camera(const msg::Header& depth, const msg::Header& image,
                         const DepthImage& stored) const;

  const BridgeOptions& options_;
  const TfBuffer& tf_;
  mutable std::mutex mutex_;
  CameraInfos infos_;
};

}  // namespace edgescout::ros2
