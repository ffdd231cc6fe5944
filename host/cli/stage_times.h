// Writes the times of stages as text: "decode 3 ms, edges 18 ms". On a device each stage also
// names what it asked of it.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>

#include "host/core/stopwatch.h"

namespace edgescout {

inline std::string host_time_text(const StageSeconds& stage) {
  const std::optional<double> seconds = stage.host_seconds();
  return seconds ? fmt::format("{:.1f} ms beside the kernels", 1000 * *seconds)
                 : "kernels not measured";
}

inline std::string device_work_text(const StageSeconds& stage) {
  const DeviceWork& work = stage.device;
  if (work.submits == 0) return "";
  return fmt::format(
      " ({}, {} submits, {} dispatches, {:.2f} MB up, {:.2f} down, "
      "{:.2f} filled, {} allocations)",
      host_time_text(stage), work.submits, work.dispatches,
      1e-6 * static_cast<double>(work.bytes_up), 1e-6 * static_cast<double>(work.bytes_down),
      1e-6 * static_cast<double>(work.bytes_filled), work.allocations);
}

inline std::string stage_times(std::span<const StageSeconds> stages) {
  std::string text;
  for (const StageSeconds& stage : stages)
    text += fmt::format("{}{} {:.0f} ms{}", text.empty() ? "" : ", ", stage.name,
                        1000 * stage.seconds, device_work_text(stage));
  return text;
}

}  // namespace edgescout
