// Finds the cameras of images: by the messages of a topic, a file or a request.
#pragma once

#include <mutex>
#include <string>

#include "host/bridge/ros2/bridge_options.h"
#include "host/bridge/ros2/camera_info.h"

namespace edgescout::ros2 {

class CameraForImage {
 public:
  // The options must outlive this object.
  explicit CameraForImage(const BridgeOptions& options) : options_(options) {}

  // A calibration of the topic. Any thread may call.
  void add(const msg::CameraInfo& info);

  // That of the file, else of the topic's message of the image's time; with an empty header the
  // latest. InputError: none came, what camera_of (camera_info.h) refuses.
  Camera calibration(const msg::Header& image) const;
  // The same, for an image of this size. InputError: as above and as camera_for_image
  // (camera_file.h).
  Camera of_topic(const msg::Header& image, int width, int height) const;
  // Of a request, which `source` names. InputError: as above.
  Camera of_request(const msg::CameraInfo& info, int width, int height,
                    const std::string& source) const;

 private:
  const BridgeOptions& options_;
  mutable std::mutex mutex_;
  CameraInfos infos_;
};

}  // namespace edgescout::ros2
