// The verbs of `edgescout bench`. Each has its own file.
#pragma once

#include <CLI/CLI.hpp>

namespace edgescout {

void add_bench_devices(CLI::App& bench, int& exit_code);
void add_bench_experiments(CLI::App& bench, int& exit_code);

}  // namespace edgescout
