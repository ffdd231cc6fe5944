// edgescout bench: runs the experiments of the paper, and compares the devices with the CPU.
#include "host/cli/bench_verbs.h"
#include "host/cli/verbs.h"

namespace edgescout {

void add_bench(CLI::App& app, int& exit_code) {
  CLI::App* bench = app.add_subcommand(
      "bench", "Rerun the paper's experiments; time the devices against the CPU");
  bench->require_subcommand(1);
  add_bench_experiments(*bench, exit_code);
  add_bench_devices(*bench, exit_code);
}

}  // namespace edgescout
