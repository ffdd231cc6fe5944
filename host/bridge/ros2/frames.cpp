#include "host/bridge/ros2/frames.h"

#include <algorithm>
#include <cstdio>

namespace edgescout::ros2 {

namespace {

constexpr std::int64_t second = 1'000'000'000;

Se3 rigid(const msg::Point& translation, const msg::Quaternion& q, const std::string& source) {
  Se3 pose{{q.w, q.x, q.y, q.z}, {translation.x, translation.y, translation.z}};
  require_rigid(pose, source, "pose");
  pose.rotation.normalize();
  return pose;
}

msg::Quaternion message_of(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
msg::Point message_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

msg::Pose message_of(const Se3& pose) {
  return {message_of(pose.translation_m), message_of(pose.rotation)};
}

msg::Transform transform_of(const Se3& pose) {
  return {message_of(pose.translation_m), message_of(pose.rotation)};
}

Se3 pose_of(const msg::Pose& pose, const std::string& source) {
  return rigid(pose.position, pose.orientation, source);
}

Se3 pose_of(const msg::Transform& transform, const std::string& source) {
  return rigid(transform.translation, transform.rotation, source);
}

std::int64_t nanoseconds(const msg::Time& stamp) { return stamp.sec * second + stamp.nanosec; }

msg::Time time_of(std::int64_t nanoseconds) {
  return {std::int32_t(nanoseconds / second), std::uint32_t(nanoseconds % second)};
}

std::string text_of(const msg::Time& stamp) {
  char text[32];
  std::snprintf(text, sizeof text, "%d.%09u", stamp.sec, stamp.nanosec);
  return text;
}

std::string shown(const std::string& text) {
  constexpr std::size_t longest = 80;
  std::string line = text.substr(0, longest);
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return line.empty() ? "an empty name" : line;
}

}  // namespace edgescout::ros2
