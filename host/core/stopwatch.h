// Measures the seconds of named stages.
//
// Public header.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace edgescout {

struct StageSeconds {
  std::string name;
  double seconds = 0;
};

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Each call of lap() adds the time since the last call to the stage of that name.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageSeconds>& stages) : stages_(stages) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    const auto known = std::ranges::find(stages_, stage, &StageSeconds::name);
    StageSeconds& lapped =
        known == stages_.end() ? stages_.emplace_back(StageSeconds{stage}) : *known;
    lapped.seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::vector<StageSeconds>& stages_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace edgescout
