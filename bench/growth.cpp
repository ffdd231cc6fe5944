// edgescout_bench_growth [--device WORD] [--repetitions N]
//
// How the time to choose the next view grows: the paper's size, then each of its four numbers three
// and ten times as large.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <string>

#include "bench/arguments.h"
#include "kernels/backend.h"
#include "kernels/cases/combination_cases.h"
#include "kernels/thread_pool.h"

namespace edgescout::bench {
namespace {

struct Times {
  double maps_s = 0, chamfer_s = 0, information_s = 0;
  double processor_s = 0;  // of all threads: what other programs on the machine change little
  double total() const { return maps_s + chamfer_s + information_s; }
};

// View by view, as planning does it: never more than one view's cells at once.
Times choose(Backend& backend, const NextViewSize& size) {
  const NextViewInput boxes(size);
  Times times;
  const auto time = [&](double& sum_s, const auto& body) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t used = std::clock();
    body();
    times.processor_s += double(std::clock() - used) / CLOCKS_PER_SEC;
    sum_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (int v = 0; v < size.views; ++v) {
    test::ChamferInput input = boxes.view(v);
    time(times.maps_s, [&] {
      backend.candidate_map(input.edges, input.maps, size.width, size.height, input.nearest);
    });
    ChamferHandle chamfer;
    time(times.chamfer_s,
         [&] { chamfer = backend.combination_chamfer(input.view(), input.combinations(), {}); });
    time(times.information_s, [&] { backend.mutual_information(*chamfer, boxes.beliefs(), {}); });
  }
  return times;
}

void report(Backend& backend, const NextViewSize& size, int repetitions) {
  std::vector<Times> runs;
  for (int r = 0; r < repetitions; ++r) runs.push_back(choose(backend, size));
  std::ranges::sort(runs, {}, &Times::total);
  const Times& median = runs[runs.size() / 2];
  std::printf("%5d %10d %9d %12u %9.1f %9.1f %11.1f %9.1f %9.1f\n", size.views, size.candidates,
              size.particles, size.combinations, 1e3 * median.maps_s, 1e3 * median.chamfer_s,
              1e3 * median.information_s, 1e3 * median.total(), 1e3 * median.processor_s);
  std::fflush(stdout);
}

void run(const std::string& device, int repetitions) {
  const std::unique_ptr<Backend> backend = make_backend(device);
  std::printf("%s, %d threads, median of %d, ms\n", backend->name().c_str(),
              backend->threads().threads(), repetitions);
  std::printf("%5s %10s %9s %12s %9s %9s %11s %9s %9s\n", "views", "candidates", "particles",
              "combinations", "maps", "chamfer", "information", "all", "processor");
  choose(*backend, {2, 4, 4, 50, 64, 48, 64});  // the driver's compiler, the first pages
  report(*backend, paper_size, repetitions);
  for (const int by : {3, 10}) {
    NextViewSize candidates = paper_size, particles = paper_size, combinations = paper_size,
                 views = paper_size;
    candidates.candidates *= by;
    particles.particles *= by;
    combinations.combinations *= std::uint32_t(by);
    views.views *= by;
    for (const NextViewSize& size : {candidates, particles, combinations, views})
      report(*backend, size, repetitions);
  }
}

}  // namespace
}  // namespace edgescout::bench

int main(int argc, char** argv) {
  try {
    std::string device = "cpu";
    int repetitions = 3;
    edgescout::bench::read_arguments(argc, argv,
                                     {{"--device", &device}, {"--repetitions", &repetitions}});
    edgescout::bench::run(device, repetitions);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "edgescout_bench_growth: %s\n", error.what());
    return 1;
  }
}
