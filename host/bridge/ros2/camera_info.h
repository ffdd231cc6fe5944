// Reads cameras of sensor_msgs/CameraInfo, and chooses the one that belongs to an image.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "host/bridge/ros2/messages.h"
#include "host/core/camera.h"

namespace edgescout::ros2 {

// By the reader of calibration files: region of interest, binning and every model that it knows.
// `rectified`: the camera of the image that image_proc makes, which is P without a lens. InputError
// naming `source` and the field; "uncalibrated" where K is all 0.
Camera camera_of(const msg::CameraInfo& info, bool rectified, const std::string& source);

// The latest calibrations of one camera. A camera whose region moves sends one an image.
class CameraInfos {
 public:
  void add(const msg::CameraInfo& info);
  bool empty() const { return infos_.empty(); }
  // The one of the image's time, else the latest one. Nothing before the first.
  const msg::CameraInfo* for_image(const msg::Header& image) const;

 private:
  std::deque<msg::CameraInfo> infos_;  // the latest last
};

}  // namespace edgescout::ros2
