// Makes grey images of ROS 2's image messages.
#pragma once

#include <variant>

#include "host/bridge/ros2/messages.h"
#include "host/core/types.h"
#include "host/io/image.h"
#include "host/io/pixels.h"

namespace edgescout::ros2 {

using ImageMessage = std::variant<msg::Image, msg::CompressedImage>;

const msg::Header& header_of(const ImageMessage& message);

// The grey image that load_image makes of a file with these pixels. The message's encoding names
// the mosaic, where it is one; `options` say the rest. InputError naming `source` and the field: an
// encoding that is no picture or unknown, another number of bytes than the size says.
Image image_of(const ImageMessage& message, const std::string& source,
               const ImageOptions& options = {});

// The message's data as pixels of the format that its encoding names; they stay in the message.
// InputError naming `source` and the field: another number of bytes than the size says.
Pixels pixels_of(const msg::Image& message, PixelFormat format, const std::string& source);

msg::Image message_of(const RgbImage& image, const msg::Header& header);  // rgb8
msg::Image message_of(const Image& image, const msg::Header& header);     // mono8

}  // namespace edgescout::ros2
