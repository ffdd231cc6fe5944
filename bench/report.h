// Measured times as a table on stdout and as bench/results/<device>.json.
#pragma once

#include <string>
#include <vector>

#include "kernels/backend.h"

namespace edgescout::bench {

struct Row {
  std::string kernel, size;
  int repetitions;
  double median_ms, min_ms, max_ms;
  std::size_t bytes;
  std::vector<StageTime> stages;  // of all repetitions together, by the device's clock
  double gigabytes_per_s() const { return double(bytes) / (median_ms * 1e6); }
};

struct Report {
  std::string device, driver, commit;
  int threads;
  std::vector<Row> rows;
};

void print_table(const Report& report);
// Creates the folder; returns the file's path. Throws std::runtime_error where it cannot be written.
std::string write_json(const Report& report, const std::string& folder);

}  // namespace edgescout::bench
