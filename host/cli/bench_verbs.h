// The verbs under `edgescout bench`, one file each.
#pragma once

#include <CLI/CLI.hpp>

namespace edgescout {

void add_bench_devices(CLI::App& bench, int& exit_code);
void add_bench_experiments(CLI::App& bench, int& exit_code);

}  // namespace edgescout
