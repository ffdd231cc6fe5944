// Writes the times of stages as text: "decode 3 ms, edges 18 ms".
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>

#include "host/core/stopwatch.h"

namespace edgescout {

inline std::string stage_times(std::span<const StageSeconds> stages) {
  std::string text;
  for (const StageSeconds& stage : stages)
    text +=
        fmt::format("{}{} {:.0f} ms", text.empty() ? "" : ", ", stage.name, 1000 * stage.seconds);
  return text;
}

}  // namespace edgescout
