#include "host/bridge/ros2/work_times.h"

#include <algorithm>

namespace edgescout::ros2 {

namespace {

constexpr double longest_silence_s = 10, of_the_last_work = 3;

double seconds_between(WorkTimes::Time from, WorkTimes::Time to) {
  return std::chrono::duration<double>(to - from).count();
}

std::string whole_seconds(WorkTimes::Time from, WorkTimes::Time to) {
  return std::to_string(long(seconds_between(from, to))) + " s";
}

}  // namespace

void WorkTimes::work_begins(const std::string& what, Time now) {
  worked_on_ = what;
  work_began_ = now;
}

void WorkTimes::work_ends(bool has_result, Time now) {
  if (work_began_) last_work_s_ = seconds_between(*work_began_, now);
  work_began_.reset();
  if (has_result) last_result_ = now;
}

std::string WorkTimes::without_image(Time now) const {
  return "no image came for " + whole_seconds(last_image_.value_or(start_), now);
}

WorkTimes::State WorkTimes::state(Time now) const {
  const std::string work =
      work_began_ ? worked_on_ + " is being worked on (" + whole_seconds(*work_began_, now) + ")"
                  : "";
  if (!last_result_) {
    const std::string none = "no result yet: ";
    if (work_began_) return {false, none + "first " + work};
    if (on_request_) return {false, none + "no request came"};
    return {seconds_between(last_image_.value_or(start_), now) > longest_silence_s,
            none + without_image(now)};
  }
  const double longest_s = std::max(longest_silence_s, of_the_last_work * last_work_s_);
  if (on_request_ || seconds_between(*last_result_, now) <= longest_s) return {false, "ok"};
  return {true, "last result is " + whole_seconds(*last_result_, now) +
                    " old: " + (work_began_ ? "an " + work : without_image(now))};
}

}  // namespace edgescout::ros2
