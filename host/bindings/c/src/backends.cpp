#include <cstdio>

#include "host/bindings/c/src/contents.h"
#include "host/bindings/c/src/structs.h"

namespace edgescout::c {

namespace {

NamedBackend named_backend(const char* device, std::int32_t threads) {
  require(device, "device");
  const std::string choice = device;
  if (threads < 0 || threads > 4096 || (threads != 0 && choice != "cpu"))
    refuse(EDGESCOUT_BAD_INPUT, "threads", std::to_string(threads) + " for " + choice,
           "0, or up to 4096 for cpu");
  std::unique_ptr<Backend> backend =
      choice == "cpu" ? make_cpu_backend(threads) : make_backend(choice);
  std::string name = backend->name();
  return {std::move(backend), std::move(name)};
}

edgescout_device shown_device(const DeviceInfo& info) {
  edgescout_device device{};
  device.is_hardware = info.hardware;
  device.memory_bytes = info.memory_bytes;
  std::snprintf(device.name, sizeof device.name, "%s", info.name.c_str());
  std::snprintf(device.driver, sizeof device.driver, "%s", info.driver.c_str());
  return device;
}

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_backend_create(const char* device, int32_t threads,
                                          edgescout_backend** out) {
  return create(out, [&] { return named_backend(device, threads); });
}

// The name never changes: it may be read while a call uses the backend.
edgescout_status edgescout_backend_name(const edgescout_backend* backend, const char** out) {
  return guarded([&] {
    require(out, "out");
    *out = live(backend)->value.name.c_str();
  });
}

edgescout_status edgescout_device_count(size_t* out) {
  return guarded([&] {
    require(out, "out");
    *out = edgescout::vulkan_devices().size();
  });
}

edgescout_status edgescout_device_at(size_t index, edgescout_device* out) {
  return guarded([&] {
    require(out, "out");
    const std::vector<edgescout::DeviceInfo> devices = edgescout::vulkan_devices();
    require_index(index, devices.size(), "index");
    write_struct(shown_device(devices[index]), out, "out");
  });
}
