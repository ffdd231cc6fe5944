// edgescout bench devices: times every stage on every device and on the CPU.
#include <fmt/format.h>

#include <iostream>

#include "commit.h"
#include "host/cli/bench_verbs.h"
#include "host/cli/exit_codes.h"
#include "host/cli/option_table.h"
#include "host/cli/progress.h"
#include "host/core/log.h"
#include "host/experiments/devices.h"
#include "host/io/files.h"
#include "host/io/folder_lock.h"

namespace edgescout {

namespace {

struct DevicesRequest {
  std::string out;
  DevicesOptions options;
};

void run(DevicesRequest& request, CLI::App& verb) {
  request.options.validate();
  for (const std::string& device : request.options.devices) make_backend(device);  // it exists
  const FolderLock lock(request.out);
  DevicesReport report;
  {
    Progress progress("devices", static_cast<std::size_t>(request.options.repetitions), std::cerr,
                      stderr_is_terminal());
    report = time_devices(request.options,
                          [&](std::size_t done, std::size_t) { progress.move_to(done); });
  }
  report.commit = EDGESCOUT_COMMIT;
  report.settings = settings_of(verb, {"Measurement", "Templates", "Edges", "Tensor", "Detection"});
  for (const std::string& warning : report.warnings) log(LogLevel::Warning, warning);
  // Printed first, since the disk may be full by now.
  std::cout << devices_markdown(report) << std::flush;
  const std::filesystem::path out = request.out;
  write_file_atomically(out / "devices.json", devices_json(report));
  write_file_atomically(out / "devices.md", devices_markdown(report));
}

}  // namespace

void add_bench_devices(CLI::App& bench, int& exit_code) {
  CLI::App* verb =
      bench.add_subcommand("devices", "Time every stage on every device found, against the CPU");
  auto request = std::make_shared<DevicesRequest>();
  DevicesOptions& o = request->options;
  verb->add_option("--out", request->out, "Folder of devices.json and devices.md")
      ->required()
      ->type_name("DIR");
  verb->add_option(
      "--device", o.devices,
      "Devices to compare with cpu: cpu-reference, vulkan or vulkan:INDEX; default: every "
      "Vulkan device");
  OptionTable(*verb, "Measurement")
      .bounded("repetitions", o.repetitions, 3, 1000, "Number of measurements of every stage")
      .bounded("image-scale", o.image_scale, 0.1, 4.0, "Scale of the image, of 1024 x 768 px")
      .bounded("seed", o.seed, 0u, 4000000000u, "Seed of the image")
      .flag("kernels,!--no-kernels", o.kernels,
            "Also time every kernel, against the device's copying speed (default)");
  CommandLineOptions add(*verb);
  describe(o.templates, add);
  describe(o.pipeline, add);
  verb->callback([request, verb, &exit_code] {
    run(*request, *verb);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
