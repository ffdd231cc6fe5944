// Counts what happens and keeps what is wrong at present, for diagnostic_msgs/DiagnosticArray.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "host/bridge/ros2/messages.h"
#include "host/bridge/ros2/work_times.h"

namespace edgescout::ros2 {

// May be used by several threads.
class Diagnostics {
 public:
  // `on_request`: as of WorkTimes.
  explicit Diagnostics(std::string node, bool on_request = false)
      : node_(std::move(node)), times_(on_request, Clock::now()) {}

  void image_comes();
  void work_begins(const std::string& what);  // "image", "request"
  void work_ends(bool has_result);

  void count(const std::string& what, std::uint64_t more = 1);
  std::uint64_t counted(const std::string& what) const;
  void set(const std::string& what, const std::string& value);

  // What is wrong of a subject ("camera_info"), until solved(subject). A warning is logged where it
  // is new, at most once in ten seconds of one subject.
  void problem(const std::string& subject, const std::string& what);
  void solved(const std::string& subject);
  std::string problem_of(const std::string& subject) const;  // empty: none

  // One status: a warning while anything is wrong or results are stale, with all counts and
  // problems as values. Its message is the first problem, else the state of WorkTimes.
  msg::DiagnosticArray message(const msg::Time& now) const;

 private:
  using Clock = std::chrono::steady_clock;

  std::string node_;
  mutable std::mutex mutex_;
  WorkTimes times_;
  std::map<std::string, std::uint64_t> counts_;
  std::map<std::string, std::string> values_, problems_;
  std::map<std::string, Clock::time_point> logged_;
};

}  // namespace edgescout::ros2
