#include "host/bridge/ros2/depth_message.h"

#include "host/bridge/ros2/frames.h"
#include "host/bridge/ros2/image_message.h"
#include "host/io/depth_file.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

PixelFormat depth_format(const msg::Image& message, const std::string& source) {
  if (message.encoding == "16UC1" || message.encoding == "mono16") return PixelFormat::Mono16;
  if (message.encoding == "32FC1") return PixelFormat::MonoFloat32;
  throw InputError(source, "encoding", shown(message.encoding), "16UC1 (mm) or 32FC1 (m)");
}

}  // namespace

void require_depth(const msg::Image& message, const std::string& source) {
  pixels_of(message, depth_format(message, source), source);
  if (nanoseconds(message.header.stamp) == 0)
    throw InputError(source, "stamp", "0", "the time at which its image was taken");
}

DepthImage depth_of(const msg::Image& message, const DepthOptions& options,
                    const std::string& source) {
  return depth_image(pixels_of(message, depth_format(message, source), source), options, source);
}

}  // namespace edgescout::ros2
