#include "host/bridge/ros2/camera_for_image.h"

#include "host/io/camera_file.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

constexpr char camera_topic[] = "camera_info";

}  // namespace

void CameraForImage::add(const msg::CameraInfo& info) {
  const std::scoped_lock lock(mutex_);
  infos_.add(info);
}

Camera CameraForImage::calibration(const msg::Header& image) const {
  Camera camera;
  if (options_.camera) {
    camera = *options_.camera;
  } else {
    const std::scoped_lock lock(mutex_);
    if (infos_.empty())
      throw InputError(camera_topic, "messages", "none", "one of the camera before");
    camera = camera_of(*infos_.for_image(image), options_.rectified, camera_topic);
  }
  camera.field_of_view_rad = options_.field_of_view_rad;
  return camera;
}

Camera CameraForImage::of_topic(const msg::Header& image, int width, int height) const {
  return camera_for_image(calibration(image), width, height, options_.scale_camera,
                          options_.camera ? options_.camera_file : camera_topic);
}

Camera CameraForImage::of_request(const msg::CameraInfo& info, int width, int height,
                                  const std::string& source) const {
  Camera camera = camera_of(info, options_.rectified, source);
  camera.field_of_view_rad = options_.field_of_view_rad;
  return camera_for_image(camera, width, height, options_.scale_camera, source);
}

}  // namespace edgescout::ros2
