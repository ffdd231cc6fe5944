// Keeps the transforms of tf and tf_static for some seconds and answers where a frame stood in
// another one.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "host/bridge/ros2/messages.h"
#include "host/core/se3.h"

namespace edgescout::ros2 {

// May be used by several threads.
class TfBuffer {
 public:
  explicit TfBuffer(double seconds = 10) : kept_ns_(std::int64_t(seconds * 1e9)) {}

  // Of the transforms that are usable all are kept. Returns one line for each that is not: a frame
  // without a name or below itself, values that are no pose, too many frames.
  std::vector<std::string> add(const msg::TFMessage& message, bool is_static);

  // target_from_source at a time, interpolated between the transforms around it. Time 0: the latest
  // that all parts of the way have. InputError: a frame that is not known, naming those that are;
  // frames that are not connected; a time before or after what is known.
  Se3 lookup(const std::string& target, const std::string& source, const msg::Time& stamp) const;
  // The same; waits so long for what is missing.
  Se3 lookup(const std::string& target, const std::string& source, const msg::Time& stamp,
             double seconds) const;
  // No lookup waits from now on.
  void stop_waiting();

  std::string known_frames() const;  // "base, camera .."; "none"

 private:
  using Poses = std::map<std::int64_t, Se3>;  // parent_from_child by ns
  struct Link {
    std::string parent;
    bool is_static = false;
    Poses poses;
  };
  // From a frame up to its root.
  struct Way {
    std::vector<std::string> frames;
    std::vector<const Link*> links;  // one less
  };

  void add(const msg::TransformStamped& transform, bool is_static);
  void require_room(const std::string& child) const;
  void drop_old(Link& link, std::int64_t stamp_ns) const;
  bool is_known(const std::string& frame) const;
  void require_known(const std::string& frame) const;
  std::string known_frames_locked() const;
  Way way_up(const std::string& frame) const;
  Se3 lookup_locked(const std::string& target, const std::string& source,
                    const msg::Time& stamp) const;
  Se3 between_locked(const std::string& target, const std::string& source,
                     std::int64_t stamp_ns) const;
  static Se3 at(const Way& way, std::size_t links, std::int64_t stamp_ns);

  std::int64_t kept_ns_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::map<std::string, Link> links_;  // by child
  bool waits_ = true;
};

}  // namespace edgescout::ros2
