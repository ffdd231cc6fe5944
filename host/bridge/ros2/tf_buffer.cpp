#include "host/bridge/ros2/tf_buffer.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <set>

#include "host/bridge/ros2/frames.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

constexpr std::int64_t any_time = std::numeric_limits<std::int64_t>::max();

// ROS 1 wrote names with a slash before them.
std::string plain(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

Se3 between(const Se3& a, const Se3& b, double share) {
  return {a.rotation.slerp(share, b.rotation),
          a.translation_m + share * (b.translation_m - a.translation_m)};
}

Se3 interpolated(const std::map<std::int64_t, Se3>& poses, std::int64_t stamp_ns,
                 const std::string& child) {
  const auto after = poses.lower_bound(stamp_ns);
  if (after != poses.end() && after->first == stamp_ns) return after->second;
  if (after == poses.end() || after == poses.begin())
    throw InputError("tf", child, "no transform of " + text_of(time_of(stamp_ns)) + " s",
                     "a time from " + text_of(time_of(poses.begin()->first)) + " to " +
                         text_of(time_of(poses.rbegin()->first)) + " s");
  const auto before = std::prev(after);
  const double share = double(stamp_ns - before->first) / double(after->first - before->first);
  return between(before->second, after->second, share);
}

}  // namespace

std::vector<std::string> TfBuffer::add(const msg::TFMessage& message, bool is_static) {
  std::vector<std::string> refused;
  {
    const std::scoped_lock lock(mutex_);
    for (const msg::TransformStamped& transform : message.transforms) {
      try {
        add(transform, is_static);
      } catch (const InputError& error) {
        refused.emplace_back(error.what());
      }
    }
  }
  changed_.notify_all();
  return refused;
}

void TfBuffer::add(const msg::TransformStamped& transform, bool is_static) {
  const std::string parent = plain(transform.header.frame_id),
                    child = plain(transform.child_frame_id);
  const std::string source = "tf: " + shown(parent) + " to " + shown(child);
  if (parent.empty() || child.empty())
    throw InputError(source, "frames", "a frame without a name", "two names");
  if (parent == child) throw InputError(source, "frames", "one frame twice", "two frames");
  const Se3 parent_from_child = pose_of(transform.transform, source);
  require_room(child);
  Link& link = links_[child];
  if (link.parent != parent || link.is_static != is_static) link = {parent, is_static, {}};
  if (is_static) link.poses.clear();
  const std::int64_t stamp_ns = nanoseconds(transform.header.stamp);
  drop_old(link, stamp_ns);
  link.poses[stamp_ns] = parent_from_child;
}

void TfBuffer::require_room(const std::string& child) const {
  constexpr std::size_t most_frames = 10'000;
  if (links_.size() >= most_frames && !links_.contains(child))
    throw InputError("tf", shown(child), "more than " + std::to_string(most_frames) + " frames",
                     "fewer");
}

// A clock that was set back, as by a bag that begins anew, ends what was known before.
void TfBuffer::drop_old(Link& link, std::int64_t stamp_ns) const {
  constexpr std::size_t most_poses = 20'000;
  if (link.poses.empty()) return;
  if (stamp_ns < link.poses.rbegin()->first - kept_ns_) link.poses.clear();
  while (!link.poses.empty() &&
         (link.poses.begin()->first < stamp_ns - kept_ns_ || link.poses.size() >= most_poses))
    link.poses.erase(link.poses.begin());
}

bool TfBuffer::is_known(const std::string& frame) const {
  return links_.contains(frame) ||
         std::ranges::any_of(links_, [&](const auto& link) { return link.second.parent == frame; });
}

void TfBuffer::require_known(const std::string& frame) const {
  if (!is_known(frame))
    throw InputError("tf", "frame", shown(frame), "a known one: " + known_frames_locked());
}

std::string TfBuffer::known_frames() const {
  const std::scoped_lock lock(mutex_);
  return known_frames_locked();
}

std::string TfBuffer::known_frames_locked() const {
  constexpr std::size_t most_shown = 30;
  std::set<std::string> names;
  for (const auto& [child, link] : links_) names.insert({child, link.parent});
  if (names.empty()) return "none";
  std::string text;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (++count > most_shown) return text + " ..";
    text += (text.empty() ? "" : ", ") + shown(name);
  }
  return text;
}

TfBuffer::Way TfBuffer::way_up(const std::string& frame) const {
  Way way{{frame}, {}};
  for (auto link = links_.find(frame); link != links_.end();
       link = links_.find(link->second.parent)) {
    way.links.push_back(&link->second);
    way.frames.push_back(link->second.parent);
    if (way.links.size() > links_.size())
      throw InputError("tf", shown(frame), "frames in a circle", "a tree");
  }
  return way;
}

// The pose of the way's first frame in the frame after so many links.
Se3 TfBuffer::at(const Way& way, std::size_t links, std::int64_t stamp_ns) {
  Se3 pose;
  for (std::size_t i = 0; i < links; ++i) {
    const Link& link = *way.links[i];
    pose = (link.is_static ? link.poses.begin()->second
                           : interpolated(link.poses, stamp_ns, shown(way.frames[i]))) *
           pose;
  }
  return pose;
}

Se3 TfBuffer::between_locked(const std::string& target, const std::string& source,
                             std::int64_t stamp_ns) const {
  require_known(target);
  require_known(source);
  const Way of_target = way_up(target), of_source = way_up(source);
  for (std::size_t up = 0; up < of_source.frames.size(); ++up) {
    const auto meets = std::ranges::find(of_target.frames, of_source.frames[up]);
    if (meets == of_target.frames.end()) continue;
    const auto down = std::size_t(meets - of_target.frames.begin());
    if (stamp_ns == 0) {
      std::int64_t latest = any_time;
      const auto include = [&](const Way& way, std::size_t links) {
        for (std::size_t i = 0; i < links; ++i)
          if (!way.links[i]->is_static)
            latest = std::min(latest, way.links[i]->poses.rbegin()->first);
      };
      include(of_source, up);
      include(of_target, down);
      stamp_ns = latest;
    }
    return inverse(at(of_target, down, stamp_ns)) * at(of_source, up, stamp_ns);
  }
  throw InputError("tf", shown(target) + " from " + shown(source), "frames that are not connected",
                   "transforms between them");
}

Se3 TfBuffer::lookup_locked(const std::string& target, const std::string& source,
                            const msg::Time& stamp) const {
  const std::string to = plain(target), from = plain(source);
  return to == from ? Se3{} : between_locked(to, from, nanoseconds(stamp));
}

Se3 TfBuffer::lookup(const std::string& target, const std::string& source,
                     const msg::Time& stamp) const {
  const std::scoped_lock lock(mutex_);
  return lookup_locked(target, source, stamp);
}

// Locked from a lookup to its wait: nothing that is added between goes unnoticed.
Se3 TfBuffer::lookup(const std::string& target, const std::string& source, const msg::Time& stamp,
                     double seconds) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::unique_lock lock(mutex_);
  for (bool is_late = false; waits_ && !is_late;) {
    try {
      return lookup_locked(target, source, stamp);
    } catch (const InputError&) {
      is_late = changed_.wait_until(lock, end) == std::cv_status::timeout;
    }
  }
  return lookup_locked(target, source, stamp);
}

void TfBuffer::stop_waiting() {
  {
    const std::scoped_lock lock(mutex_);
    waits_ = false;
  }
  changed_.notify_all();
}

}  // namespace edgescout::ros2
