// edgescout_bench [--device WORD] [--out FOLDER] [--repetitions N] [--small]
//
// Times every kernel on the CPU, on the plain reference (small sizes) and on every Vulkan device
// found.
#include <cstdio>
#include <exception>

#include "bench/arguments.h"
#include "bench/report.h"
#include "commit.h"
#include "kernels/cases/measure.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout::bench {
namespace {

struct Options {
  std::string device;  // empty: all
  std::string out = "bench/results";
  int repetitions = 9;
  bool small = false;
};

Options parse(int argc, char** argv) {
  Options options;
  read_arguments(argc, argv,
                 {{"--device", &options.device},
                  {"--out", &options.out},
                  {"--repetitions", &options.repetitions},
                  {"--small", &options.small}});
  return options;
}

void run_device(const std::string& word, const std::string& driver, const Options& options) {
  const std::unique_ptr<Backend> backend = make_backend(word, {.time_kernels = true});
  Report report{backend->name(), driver, EDGESCOUT_COMMIT, backend->threads().threads(), {}};
  std::vector<Size> sizes{Size::small};
  if (!options.small && word != "cpu-reference") sizes.push_back(Size::full);
  for (const Size size : sizes)
    for (const Case& c : make_cases(*backend, size))
      report.rows.push_back(measure(*backend, c, options.repetitions));
  print_table(report);
  std::printf("-> %s\n", write_json(report, options.out).c_str());
}

void run(const Options& options) {
  std::vector<std::pair<std::string, std::string>> devices{{"cpu", "C++"},
                                                           {"cpu-reference", "C++"}};
  for (const DeviceInfo& device : vulkan_devices())
    devices.emplace_back("vulkan:" + std::to_string(device.index), device.driver);
  bool found = false;
  for (const auto& [word, driver] : devices) {
    if (!options.device.empty() && options.device != word) continue;
    found = true;
    run_device(word, driver, options);
  }
  if (!found)
    throw InputError("command line", "--device", options.device,
                     "cpu, cpu-reference or a vulkan:INDEX that exists");
}

}  // namespace
}  // namespace edgescout::bench

int main(int argc, char** argv) {
  try {
    edgescout::bench::run(edgescout::bench::parse(argc, argv));
    return 0;
  } catch (const edgescout::InputError& error) {
    std::fprintf(stderr, "edgescout_bench: %s\n", error.what());
    return 2;
  } catch (const edgescout::GpuError& error) {
    std::fprintf(stderr, "edgescout_bench: %s\n", error.what());
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "edgescout_bench: %s\n", error.what());
    return 1;
  }
}
