#include "kernels/gpu/device_info.h"

#include "kernels/error.h"
#include "kernels/gpu/instance.h"

namespace edgescout {

namespace gpu {

DeviceInfo describe(VkPhysicalDevice device, int index) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &properties);
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(device, &memory);

  const VkPhysicalDeviceProperties& p = properties.properties;
  DeviceInfo info;
  info.index = index;
  info.name = p.deviceName;
  info.driver = driver.driverName;
  if (driver.driverInfo[0] != '\0')
    info.driver += std::string(" ") + driver.driverInfo;  // some say nothing
  info.api_version = std::to_string(VK_API_VERSION_MAJOR(p.apiVersion)) + "." +
                     std::to_string(VK_API_VERSION_MINOR(p.apiVersion)) + "." +
                     std::to_string(VK_API_VERSION_PATCH(p.apiVersion));
  info.hardware = p.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
  info.discrete = p.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      info.memory_bytes += memory.memoryHeaps[i].size;
  info.max_storage_buffer_bytes = p.limits.maxStorageBufferRange;
  return info;
}

}  // namespace gpu

std::vector<DeviceInfo> vulkan_devices() {
  std::vector<DeviceInfo> list;
  try {
    for (VkPhysicalDevice device : gpu::shared_instance(false).physical_devices())
      list.push_back(gpu::describe(device, static_cast<int>(list.size())));
  } catch (const GpuError&) {
    // A loader without a usable driver: no devices is the answer, not a failure.
  }
  return list;
}

}  // namespace edgescout
