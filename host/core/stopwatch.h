// Where the time goes: seconds by named stage.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace edgescout {

struct StageSeconds {
  std::string name;
  double seconds = 0;
};

// Names the time between two calls.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageSeconds>& stages) : stages_(stages) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    stages_.push_back({stage, std::chrono::duration<double>(now - last_).count()});
    last_ = now;
  }

 private:
  std::vector<StageSeconds>& stages_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace edgescout
