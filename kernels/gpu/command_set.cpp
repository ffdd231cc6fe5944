#include "kernels/gpu/command_set.h"

#include "kernels/gpu/result.h"

namespace edgescout::gpu {

namespace {

constexpr std::size_t most_kept = 4;  // as many batches are hardly ever open side by side

Handle<VkCommandPool> create_pool(const Device& device) {
  VkCommandPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  info.queueFamilyIndex = device.queue_family();
  VkCommandPool pool = VK_NULL_HANDLE;
  require(vkCreateCommandPool(device.get(), &info, nullptr, &pool), "vkCreateCommandPool");
  return {device.get(), pool, vkDestroyCommandPool};
}

VkCommandBuffer allocate_commands(const Device& device, VkCommandPool pool) {
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  require(vkAllocateCommandBuffers(device.get(), &info, &commands), "vkAllocateCommandBuffers");
  return commands;
}

Handle<VkFence> create_fence(const Device& device) {
  VkFenceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  require(vkCreateFence(device.get(), &info, nullptr, &fence), "vkCreateFence");
  return {device.get(), fence, vkDestroyFence};
}

CommandSet create_set(const Device& device) {
  CommandSet set;
  set.pool = create_pool(device);
  set.commands = allocate_commands(device, set.pool.get());
  set.fence = create_fence(device);
  return set;
}

void reset(const Device& device, const CommandSet& set) {
  require(vkResetCommandPool(device.get(), set.pool.get(), 0), "vkResetCommandPool");
  VkFence fence = set.fence.get();
  require(vkResetFences(device.get(), 1, &fence), "vkResetFences");
  for (const Handle<VkDescriptorPool>& pool : set.descriptors)
    require(vkResetDescriptorPool(device.get(), pool.get(), 0), "vkResetDescriptorPool");
}

}  // namespace

Handle<VkQueryPool> create_queries(const Device& device) {
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2 * TIMED_PER_POOL;
  VkQueryPool queries = VK_NULL_HANDLE;
  require(vkCreateQueryPool(device.get(), &info, nullptr, &queries), "vkCreateQueryPool");
  return {device.get(), queries, vkDestroyQueryPool};
}

Handle<VkDescriptorPool> create_descriptors(const Device& device) {
  const VkDescriptorPoolSize sizes[] = {
      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, SETS_PER_POOL * BINDINGS_PER_SET},
      {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, SETS_PER_POOL}};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = SETS_PER_POOL;
  info.poolSizeCount = 2;
  info.pPoolSizes = sizes;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  require(vkCreateDescriptorPool(device.get(), &info, nullptr, &pool), "vkCreateDescriptorPool");
  return {device.get(), pool, vkDestroyDescriptorPool};
}

CommandSet CommandSets::take() {
  CommandSet set;
  if (free_.empty()) {
    set = create_set(device_);
  } else {
    set = std::move(free_.back());
    free_.pop_back();
    reset(device_, set);
  }
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  require(vkBeginCommandBuffer(set.commands, &begin), "vkBeginCommandBuffer");
  return set;
}

void CommandSets::give_back(CommandSet set) {
  if (free_.size() < most_kept) free_.push_back(std::move(set));
}

}  // namespace edgescout::gpu
