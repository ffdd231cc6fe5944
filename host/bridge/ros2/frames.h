// Poses between the library's types and ROS 2's messages.
#pragma once

#include <cstdint>
#include <string>

#include "host/bridge/ros2/messages.h"
#include "host/core/se3.h"

namespace edgescout::ros2 {

msg::Pose message_of(const Se3& pose);
msg::Transform transform_of(const Se3& pose);
// InputError naming `source`: values that are not finite, a quaternion whose length is not 1 to
// 1e-3. One of zeros alone, which many programs leave in messages, is refused as well.
Se3 pose_of(const msg::Pose& pose, const std::string& source);
Se3 pose_of(const msg::Transform& transform, const std::string& source);

std::int64_t nanoseconds(const msg::Time& stamp);
msg::Time time_of(std::int64_t nanoseconds);
std::string text_of(const msg::Time& stamp);  // "12.345678901"

// A frame's name or another text of the network, of one line and at most 80 signs.
std::string shown(const std::string& text);

}  // namespace edgescout::ros2
