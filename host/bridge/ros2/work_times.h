// When images came and results were made: whether a node's results are of the present.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace edgescout::ros2 {

class WorkTimes {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `on_request`: images alone make no results.
  WorkTimes(bool on_request, Time start) : on_request_(on_request), start_(start) {}

  void image_comes(Time now) { last_image_ = now; }
  // `what`: "image", "request".
  void work_begins(const std::string& what, Time now);
  void work_ends(bool has_result, Time now);

  struct State {
    bool is_stale = false;
    std::string text;  // "ok", or why there is no result of the present
  };
  // Not stale: the first image is worked on, however long; images come and results are younger than
  // ten seconds or three times as long as the last work took.
  State state(Time now) const;

 private:
  std::string without_image(Time now) const;

  bool on_request_;
  Time start_;
  std::optional<Time> last_image_, last_result_, work_began_;
  std::string worked_on_;
  double last_work_s_ = 0;
};

}  // namespace edgescout::ros2
