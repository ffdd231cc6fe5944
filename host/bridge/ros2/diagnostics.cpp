#include "host/bridge/ros2/diagnostics.h"

#include "host/core/log.h"

namespace edgescout::ros2 {

void Diagnostics::image_comes() {
  const std::scoped_lock lock(mutex_);
  times_.image_comes(Clock::now());
}

void Diagnostics::work_begins(const std::string& what) {
  const std::scoped_lock lock(mutex_);
  times_.work_begins(what, Clock::now());
}

void Diagnostics::work_ends(bool has_result) {
  const std::scoped_lock lock(mutex_);
  times_.work_ends(has_result, Clock::now());
}

void Diagnostics::count(const std::string& what, std::uint64_t more) {
  const std::scoped_lock lock(mutex_);
  counts_[what] += more;
}

std::uint64_t Diagnostics::counted(const std::string& what) const {
  const std::scoped_lock lock(mutex_);
  const auto found = counts_.find(what);
  return found == counts_.end() ? 0 : found->second;
}

void Diagnostics::set(const std::string& what, const std::string& value) {
  const std::scoped_lock lock(mutex_);
  values_[what] = value;
}

void Diagnostics::problem(const std::string& subject, const std::string& what) {
  constexpr std::chrono::seconds between_lines{10};
  const std::scoped_lock lock(mutex_);
  std::string& present = problems_[subject];
  if (present == what) return;
  present = what;
  const auto now = Clock::now();
  const auto last = logged_.find(subject);
  if (last != logged_.end() && now < last->second + between_lines) return;
  logged_[subject] = now;
  log(LogLevel::Warning, what);
}

void Diagnostics::solved(const std::string& subject) {
  const std::scoped_lock lock(mutex_);
  problems_.erase(subject);
}

std::string Diagnostics::problem_of(const std::string& subject) const {
  const std::scoped_lock lock(mutex_);
  const auto found = problems_.find(subject);
  return found == problems_.end() ? "" : found->second;
}

msg::DiagnosticArray Diagnostics::message(const msg::Time& now) const {
  const std::scoped_lock lock(mutex_);
  const WorkTimes::State state = times_.state(Clock::now());
  const bool is_well = problems_.empty() && !state.is_stale;
  msg::DiagnosticStatus status{
      .level = std::uint8_t(is_well ? 0 : 1),
      .name = node_ + ": detection",
      .message = problems_.empty() ? state.text : problems_.begin()->second,
      .hardware_id = node_};
  for (const auto& [subject, what] : problems_) status.values.push_back({subject, what});
  for (const auto& [what, number] : counts_)
    status.values.push_back({what, std::to_string(number)});
  for (const auto& [what, value] : values_) status.values.push_back({what, value});
  return {{now, ""}, {status}};
}

}  // namespace edgescout::ros2
