// The choice of a backend by name, and the timings every backend keeps.
#include "kernels/backend.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <utility>

#include "kernels/error.h"

namespace edgescout {

std::vector<StageTime> Backend::take_timings() { return std::exchange(timings_, {}); }

void Backend::add_time(const std::string& name, double seconds) {
  auto row = std::ranges::find(timings_, name, &StageTime::name);
  if (row == timings_.end()) row = timings_.insert(row, StageTime{name, 0, 0});
  row->seconds += seconds;
  ++row->calls;
}

#ifndef EDGESCOUT_VULKAN
std::vector<DeviceInfo> vulkan_devices() { return {}; }

std::unique_ptr<Backend> make_vulkan_backend(int index, const BackendOptions&) {
  throw InputError("options", "device", "vulkan:" + std::to_string(index),
                   "cpu or cpu-reference: edgescout was built without Vulkan");
}
#endif

std::vector<DeviceInfo> in_order_of_use(std::vector<DeviceInfo> devices) {
  std::ranges::stable_sort(devices, std::greater{}, [](const DeviceInfo& device) {
    return device.discrete ? 2 : device.hardware ? 1 : 0;
  });
  return devices;
}

int usual_vulkan_device() {
  const std::vector<DeviceInfo> devices = in_order_of_use(vulkan_devices());
  return devices.empty() ? 0 : devices.front().index;
}

namespace {

constexpr const char* vulkan_prefix = "vulkan:";

std::unique_ptr<Backend> make_checked_vulkan(int index, const std::string& choice,
                                             const BackendOptions& options) {
#ifdef EDGESCOUT_VULKAN
  const std::size_t count = vulkan_devices().size();
  if (index < 0 || static_cast<std::size_t>(index) >= count)
    throw InputError("options", "device", choice,
                     count == 0 ? "a Vulkan device, of which this machine has none: try cpu"
                                : "vulkan:0 to vulkan:" + std::to_string(count - 1));
#endif
  (void)choice;
  return make_vulkan_backend(index, options);
}

// A card whose driver is too old for the kernels is passed over; the backend's name says what was
// taken.
std::unique_ptr<Backend> make_automatic(const BackendOptions& options) {
  for (const DeviceInfo& device : in_order_of_use(vulkan_devices())) {
    if (!device.hardware) break;
    try {
      return make_vulkan_backend(device.index, options);
    } catch (const GpuError&) {
      continue;
    }
  }
  return make_cpu_backend();
}

}  // namespace

std::unique_ptr<Backend> make_backend(const std::string& choice, const BackendOptions& options) {
  if (choice == "auto") return make_automatic(options);
  if (choice == "cpu") return make_cpu_backend();
  if (choice == "cpu-reference") return make_reference_backend();
  if (choice == "vulkan") return make_checked_vulkan(usual_vulkan_device(), choice, options);
  if (choice.starts_with(vulkan_prefix)) {
    const char *first = choice.data() + std::char_traits<char>::length(vulkan_prefix),
               *last = choice.data() + choice.size();
    int index = -1;
    const auto [end, error] = std::from_chars(first, last, index);
    if (error == std::errc() && end == last && index >= 0)
      return make_checked_vulkan(index, choice, options);
  }
  throw InputError("options", "device", choice, "auto, cpu, cpu-reference, vulkan or vulkan:INDEX");
}

}  // namespace edgescout
