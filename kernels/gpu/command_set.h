// What a batch is recorded in, timed and waited for, kept for the next one: to make it anew may
// cost a driver more than a short kernel takes.
#pragma once

#include <vector>

#include <vulkan/vulkan.h>

#include "kernels/gpu/device.h"
#include "kernels/gpu/handle.h"

namespace edgescout::gpu {

inline constexpr std::uint32_t TIMED_PER_POOL = 64;  // dispatches, two timestamps each
inline constexpr std::uint32_t SETS_PER_POOL = 32;
inline constexpr std::uint32_t BINDINGS_PER_SET = 8;

struct CommandSet {
  Handle<VkCommandPool> pool;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  Handle<VkFence> fence;
  std::vector<Handle<VkQueryPool>> queries;
  std::vector<Handle<VkDescriptorPool>> descriptors;
};

Handle<VkQueryPool> create_queries(const Device& device);
Handle<VkDescriptorPool> create_descriptors(const Device& device);

class CommandSets {
 public:
  explicit CommandSets(const Device& device) : device_(device) {}
  // Its commands are being recorded, its fence is not signalled, no descriptor is allocated. Throws
  // GpuError.
  CommandSet take();
  // Of commands that have run, or never will.
  void give_back(CommandSet set);

 private:
  const Device& device_;
  std::vector<CommandSet> free_;
};

}  // namespace edgescout::gpu
