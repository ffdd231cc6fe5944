// Makes depth images of ROS 2's image messages (REP 118).
#pragma once

#include <string>

#include "host/bridge/ros2/messages.h"
#include "host/core/depth_image.h"
#include "host/io/depth_options.h"

namespace edgescout::ros2 {

// What the message itself can say, before its values are read. InputError naming `source` and the
// field: another encoding than 16UC1, mono16 (mm) or 32FC1 (m), another number of bytes than the
// size says, a stamp of 0, which belongs to every image and to none.
void require_depth(const msg::Image& message, const std::string& source);

// InputError: as require_depth, but for the stamp; values none of which lies inside the range
// (io/depth_file.h).
DepthImage depth_of(const msg::Image& message, const DepthOptions& options,
                    const std::string& source);

}  // namespace edgescout::ros2
