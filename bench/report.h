// Measured times as a table on stdout and as bench/results/<device>.json.
#pragma once

#include <string>
#include <vector>

#include "kernels/cases/measure.h"

namespace edgescout::bench {

struct Report {
  std::string device, driver, commit;
  int threads;
  std::vector<Row> rows;
};

void print_table(const Report& report);
// Creates the folder; returns the file's path. Throws std::runtime_error where it cannot be
// written.
std::string write_json(const Report& report, const std::string& folder);

}  // namespace edgescout::bench
