// edgescout devices: lists the Vulkan devices and the device that --device would use.
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/verbs.h"
#include "host/io/json_text.h"
#include "kernels/backend.h"

namespace edgescout {

namespace {

nlohmann::json device_json(const DeviceInfo& device) {
  return {{"choice", "vulkan:" + std::to_string(device.index)},
          {"name", device.name},
          {"driver", device.driver},
          {"api_version", device.api_version},
          {"hardware", device.hardware},
          {"memory_bytes", device.memory_bytes},
          {"max_storage_buffer_bytes", device.max_storage_buffer_bytes}};
}

struct DevicesOptions {
  std::string device = "auto";
  bool as_json = false;
};

void list_devices(const DevicesOptions& options) {
  const std::vector<DeviceInfo> devices = vulkan_devices();
  const std::string taken = make_backend(options.device)->name();
  if (options.as_json) {
    nlohmann::json list = nlohmann::json::array();
    for (const DeviceInfo& device : devices) list.push_back(device_json(device));
    std::cout << json_text(
        nlohmann::json{{"devices", list}, {"asked", options.device}, {"taken", taken}});
    return;
  }
  for (const DeviceInfo& device : devices)
    std::cout << fmt::format(
        "vulkan:{}  {}, {}, driver {}, Vulkan {}, {:.1f} GiB, buffers up to {} MiB\n", device.index,
        device.name, device.hardware ? "hardware" : "software", device.driver, device.api_version,
        static_cast<double>(device.memory_bytes) / (1u << 30),
        device.max_storage_buffer_bytes >> 20);
  if (devices.empty()) std::cout << "no Vulkan device\n";
  std::cout << "cpu\n" << options.device << " takes: " << taken << "\n";
}

}  // namespace

void add_devices(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("devices", "List the Vulkan devices and the one that --device takes");
  auto options = std::make_shared<DevicesOptions>();
  add_device(*verb, options->device);
  verb->add_flag("--json", options->as_json, "Print JSON");
  verb->callback([options, &exit_code] {
    list_devices(*options);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
