// One Vulkan device with one compute queue: its limits, its memory types, what every other object
// here is made from. Used by one thread at a time, like the Backend that owns it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "kernels/backend.h"
#include "kernels/device_work.h"
#include "kernels/gpu/device_options.h"
#include "kernels/gpu/handle.h"
#include "kernels/gpu/instance.h"

namespace edgescout::gpu {

class BufferStore;
class CommandSets;

class Device {
 public:
  // Throws GpuError: no such device, older than Vulkan 1.2, or no compute queue.
  explicit Device(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkDevice get() const { return device_.get(); }
  VkQueue queue() const { return queue_; }
  std::uint32_t queue_family() const { return queue_family_; }
  VkPipelineCache pipeline_cache() const { return cache_.get(); }
  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  VkDeviceSize max_allocation_bytes() const { return max_allocation_bytes_; }
  // Throws GpuError where `bytes` of what `name` says are more than one binding takes.
  void check_range(VkDeviceSize bytes, const std::string& name) const;
  // Most bytes in one binding, of what is cut to fit: tensors, maps, poses.
  VkDeviceSize max_band_bytes() const { return max_band_bytes_; }
  // Whether kernels are timed: asked for, and the queue can write timestamps.
  bool times_kernels() const { return seconds_per_tick_ > 0; }
  // Between two timestamps, which may have fewer than 64 bits and wrap.
  double seconds_between(std::uint64_t first_tick, std::uint64_t last_tick) const {
    return seconds_per_tick_ * double((last_tick - first_tick) & tick_mask_);
  }
  // Invocations that run in step, where they fill a group.
  std::uint32_t subgroup_size() const { return subgroup_size_; }
  // Device-local memory can be read and written by the host at full speed: no staging.
  bool unified_memory() const { return unified_memory_; }
  BufferStore& buffers() const { return *buffers_; }
  CommandSets& command_sets() const { return *command_sets_; }
  // Everything made from this device adds to it.
  DeviceWork& work() const { return *work_; }

  // First memory type of `allowed` (a bit set) with all of `needed` and `wanted`, or, where there
  // is none, of `needed` alone; throws GpuError where there is none of these either.
  std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags needed,
                            VkMemoryPropertyFlags wanted) const;

 private:
  struct Destroy {
    void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
  };

  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  std::unique_ptr<std::remove_pointer_t<VkDevice>, Destroy> device_;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t queue_family_ = 0;
  Handle<VkPipelineCache> cache_;
  DeviceInfo info_;
  VkPhysicalDeviceLimits limits_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  VkDeviceSize max_allocation_bytes_ = 0, max_band_bytes_ = 0;
  std::uint32_t subgroup_size_ = 0;
  double seconds_per_tick_ = 0;
  std::uint64_t tick_mask_ = ~std::uint64_t{0};
  bool unified_memory_ = false;
  std::unique_ptr<DeviceWork> work_ = std::make_unique<DeviceWork>();
  std::unique_ptr<BufferStore> buffers_;
  std::unique_ptr<CommandSets> command_sets_;
};

}  // namespace edgescout::gpu
