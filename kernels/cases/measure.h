// How long a case takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernels/cases/cases.h"

namespace edgescout::bench {

struct Row {
  std::string kernel, size;
  int repetitions;
  double median_ms, min_ms, max_ms;
  std::size_t bytes;
  std::vector<StageTime> stages;  // of all repetitions together, by the device's clock
  // Of one repetition, without the host's share: uploads, submission, downloads. Nothing where no
  // device's clock ran.
  std::optional<double> on_device_ms() const;
  double gigabytes_per_s() const { return double(bytes) / (median_ms * 1e6); }
};

// After one repetition that does not count. A slow device gets fewer, but three.
Row measure(Backend& backend, const Case& timed, int repetitions);

}  // namespace edgescout::bench
