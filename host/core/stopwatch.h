// Measures named stages: their time, and what they asked of a device.
//
// Public header.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "kernels/backend.h"

namespace edgescout {

struct StageSeconds {
  std::string name;
  double seconds = 0;
  DeviceWork device{};  // all 0 on the CPU
  // Returns the time beside the device's kernels; nothing where these were not timed.
  std::optional<double> host_seconds() const {
    const std::optional<double> in_kernels = device.kernel_seconds();
    return in_kernels ? std::optional(seconds - *in_kernels) : std::nullopt;
  }
};

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Each call of lap() adds what was since the last call to the stage of that name.
class Stopwatch {
 public:
  Stopwatch(std::vector<StageSeconds>& stages, const Backend& backend)
      : stages_(stages), backend_(backend) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    const auto known = std::ranges::find(stages_, stage, &StageSeconds::name);
    StageSeconds& lapped =
        known == stages_.end() ? stages_.emplace_back(StageSeconds{stage}) : *known;
    lapped.seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
    const DeviceWork work = backend_.device_work();
    lapped.device += work - last_work_;
    last_work_ = work;
  }

 private:
  std::vector<StageSeconds>& stages_;
  const Backend& backend_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  DeviceWork last_work_ = backend_.device_work();
};

}  // namespace edgescout
