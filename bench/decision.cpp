// edgescout_bench_decision [--device WORD] [--repetitions N] [--growth]
//
// One whole decision where to look next (host/experiments/decision.h): from refined candidates and
// particles of a rendered bin to the best of all views. With --growth also each of its four numbers
// three and ten times as large.
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "bench/arguments.h"
#include "host/experiments/decision.h"
#include "host/experiments/machine.h"
#include "kernels/thread_pool.h"

namespace {

using namespace edgescout;

void report(const Bin& bin, const DecisionSize& size, Backend& backend, int repetitions) {
  const DecisionWork work = make_decision_work(bin, size, backend);
  decide(work, backend);  // the driver's compiler, the first pages
  forget_peak_memory();
  std::vector<double> seconds;
  for (int r = 0; r < repetitions; ++r) {
    const auto start = std::chrono::steady_clock::now();
    decide(work, backend);
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::ranges::sort(seconds);
  std::printf("%5d %10d %9d %12d %9.3f %9.0f\n", size.views, size.candidates, size.particles,
              size.combinations, seconds[seconds.size() / 2], double(peak_memory_bytes()) / 1e6);
  std::fflush(stdout);
}

void run(const std::string& device, int repetitions, bool growth) {
  const std::unique_ptr<Backend> backend = make_backend(device);
  std::printf("%s, %d threads, median of %d\n", backend->name().c_str(),
              backend->threads().threads(), repetitions);
  std::printf("%5s %10s %9s %12s %9s %9s\n", "views", "candidates", "particles", "combinations",
              "seconds", "peak, MB");
  const Bin bin = decision_bin(backend->threads());
  report(bin, {}, *backend, repetitions);
  for (const int by : {3, 10})
    for (int DecisionSize::*const number :
         {&DecisionSize::views, &DecisionSize::candidates, &DecisionSize::particles,
          &DecisionSize::combinations}) {
      if (!growth) return;
      DecisionSize size;
      size.*number *= by;
      report(bin, size, *backend, repetitions);
    }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::string device = "cpu";
    int repetitions = 5;
    bool growth = false;
    bench::read_arguments(
        argc, argv,
        {{"--device", &device}, {"--repetitions", &repetitions}, {"--growth", &growth}});
    run(device, repetitions, growth);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "edgescout_bench_decision: %s\n", error.what());
    return 1;
  }
}
