#include "kernels/gpu/device.h"

#include "kernels/error.h"
#include "kernels/gpu/buffer_store.h"
#include "kernels/gpu/command_set.h"
#include "kernels/gpu/device_info.h"
#include "kernels/gpu/extensions.h"
#include "kernels/gpu/result.h"

namespace edgescout::gpu {

namespace {

VkPhysicalDevice pick(const Instance& instance, int index) {
  const std::vector<VkPhysicalDevice> devices = instance.physical_devices();
  if (index < 0 || index >= static_cast<int>(devices.size()))
    throw GpuError("no Vulkan device " + std::to_string(index) + ": " +
                   std::to_string(devices.size()) + " found");
  return devices[index];
}

struct Properties {
  VkPhysicalDeviceLimits limits;
  std::uint32_t api_version, subgroup_size;
  VkDeviceSize max_allocation_bytes;
};

Properties properties_of(VkPhysicalDevice device) {
  VkPhysicalDeviceMaintenance3Properties maintenance{};
  maintenance.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  VkPhysicalDeviceSubgroupProperties subgroup{};
  subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  subgroup.pNext = &maintenance;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &subgroup;
  vkGetPhysicalDeviceProperties2(device, &properties);
  return {properties.properties.limits, properties.properties.apiVersion, subgroup.subgroupSize,
          maintenance.maxMemoryAllocationSize};
}

// A family that can compute; one that cannot draw leaves the desktop alone.
std::uint32_t compute_family(VkPhysicalDevice device, const std::string& name,
                             std::uint32_t& timestamp_bits) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  std::uint32_t best = count;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT)) continue;
    if (best == count || !(families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT)) best = i;
  }
  if (best == count) throw GpuError(name + ": no compute queue");
  timestamp_bits = families[best].timestampValidBits;
  return best;
}

VkDevice create_device(VkPhysicalDevice physical, std::uint32_t family) {
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  // What is no whole Vulkan, such as MoltenVK, has to be told that this is known.
  const char* portability_subset = "VK_KHR_portability_subset";
  if (device_offers(physical, portability_subset)) {
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &portability_subset;
  }
  VkDevice device = VK_NULL_HANDLE;
  require(vkCreateDevice(physical, &info, nullptr, &device), "vkCreateDevice");
  return device;
}

VkPipelineCache create_cache(VkDevice device) {
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  VkPipelineCache cache = VK_NULL_HANDLE;
  require(vkCreatePipelineCache(device, &info, nullptr, &cache), "vkCreatePipelineCache");
  return cache;
}

// Cached memory only: reading a discrete card's window over the bus is slower than a staged copy.
bool is_unified(const VkPhysicalDeviceMemoryProperties& memory) {
  constexpr VkMemoryPropertyFlags all =
      VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
      VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((memory.memoryTypes[i].propertyFlags & all) == all) return true;
  return false;
}

void hide_cached(VkPhysicalDeviceMemoryProperties& memory) {
  for (VkMemoryType& type : memory.memoryTypes)
    type.propertyFlags &= ~VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
}

}  // namespace

Device::Device(const DeviceOptions& options)
    : physical_(pick(shared_instance(options.validation), options.index)),
      info_(describe(physical_, options.index)) {
  const Properties properties = properties_of(physical_);
  if (properties.api_version < VK_API_VERSION_1_2)
    throw GpuError(info_.name + ": Vulkan " + info_.api_version + ", at least 1.2 is needed");
  limits_ = properties.limits;
  subgroup_size_ = properties.subgroup_size;
  max_allocation_bytes_ = properties.max_allocation_bytes;
  max_band_bytes_ =
      options.max_band_bytes > 0 ? options.max_band_bytes : limits_.maxStorageBufferRange;
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  if (options.staging) hide_cached(memory_);
  if (options.as_hardware > 0) {
    info_.hardware = true;
    subgroup_size_ = options.as_hardware;
  }
  unified_memory_ = is_unified(memory_);

  std::uint32_t timestamp_bits = 0;
  queue_family_ = compute_family(physical_, info_.name, timestamp_bits);
  if (timestamp_bits < 64) tick_mask_ = (std::uint64_t{1} << timestamp_bits) - 1;
  if (options.time_kernels && timestamp_bits > 0)
    seconds_per_tick_ = 1e-9 * double(limits_.timestampPeriod);
  device_.reset(create_device(physical_, queue_family_));
  vkGetDeviceQueue(get(), queue_family_, 0, &queue_);
  cache_ = {get(), create_cache(get()), vkDestroyPipelineCache};
  buffers_ = std::make_unique<BufferStore>(*this);
  command_sets_ = std::make_unique<CommandSets>(*this);
}

Device::~Device() = default;

void Device::check_range(VkDeviceSize bytes, const std::string& name) const {
  if (bytes > limits_.maxStorageBufferRange)
    throw GpuError(name + " of " + std::to_string(bytes) + " bytes, " + info_.name +
                   " binds at most " + std::to_string(limits_.maxStorageBufferRange));
}

std::uint32_t Device::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags needed,
                                  VkMemoryPropertyFlags wanted) const {
  for (const VkMemoryPropertyFlags flags : {needed | wanted, needed})
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
      if ((allowed >> i & 1u) != 0 && (memory_.memoryTypes[i].propertyFlags & flags) == flags)
        return i;
  throw GpuError(info_.name + ": no memory type with property flags " + std::to_string(needed));
}

}  // namespace edgescout::gpu
