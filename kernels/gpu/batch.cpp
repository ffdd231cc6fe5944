#include "kernels/gpu/batch.h"

#include <algorithm>
#include <cstring>

#include "kernels/error.h"
#include "kernels/gpu/result.h"
#include "kernels/gpu/staging.h"

namespace edgescout::gpu {

namespace {

constexpr std::uint32_t timed_per_pool = 64;
constexpr std::uint32_t sets_per_pool = 32;
constexpr std::uint32_t bindings_per_set = 8;

constexpr VkAccessFlags any_write = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
constexpr VkAccessFlags any_access = any_write | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;
constexpr VkPipelineStageFlags any_stage =
    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;

void memory_barrier(VkCommandBuffer commands, VkAccessFlags to, VkPipelineStageFlags stages) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = any_write;
  barrier.dstAccessMask = to;
  vkCmdPipelineBarrier(commands, any_stage, stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

Handle<VkCommandPool> create_pool(const Device& device) {
  VkCommandPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  info.queueFamilyIndex = device.queue_family();
  VkCommandPool pool = VK_NULL_HANDLE;
  require(vkCreateCommandPool(device.get(), &info, nullptr, &pool), "vkCreateCommandPool");
  return {device.get(), pool, vkDestroyCommandPool};
}

VkCommandBuffer begin_commands(const Device& device, VkCommandPool pool) {
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  require(vkAllocateCommandBuffers(device.get(), &info, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  require(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  return commands;
}

Handle<VkQueryPool> create_queries(const Device& device) {
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2 * timed_per_pool;
  VkQueryPool queries = VK_NULL_HANDLE;
  require(vkCreateQueryPool(device.get(), &info, nullptr, &queries), "vkCreateQueryPool");
  return {device.get(), queries, vkDestroyQueryPool};
}

Handle<VkDescriptorPool> create_descriptor_pool(const Device& device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, sets_per_pool * bindings_per_set};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = sets_per_pool;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  require(vkCreateDescriptorPool(device.get(), &info, nullptr, &pool), "vkCreateDescriptorPool");
  return {device.get(), pool, vkDestroyDescriptorPool};
}

Handle<VkFence> create_fence(const Device& device) {
  VkFenceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  require(vkCreateFence(device.get(), &info, nullptr, &fence), "vkCreateFence");
  return {device.get(), fence, vkDestroyFence};
}

std::string described(const Kernel& kernel, Groups groups) {
  return kernel.name() + " " + std::to_string(groups.x) + "x" + std::to_string(groups.y) + "x" +
         std::to_string(groups.z);
}

}  // namespace

Batch::Batch(const Device& device, std::string name)
    : device_(device),
      name_(std::move(name)),
      pool_(create_pool(device)),
      commands_(begin_commands(device, pool_.get())) {}

Batch::~Batch() {
  for (RawBuffer& buffer : staging_) device_.staging().give_back(std::move(buffer));
}

const RawBuffer& Batch::stage(VkDeviceSize bytes, Memory memory, const RawBuffer& other_end) {
  staging_.push_back(device_.staging().take(bytes, memory, "staging for " + other_end.name()));
  return staging_.back();
}

void Batch::copy_bytes(VkBuffer from, VkBuffer to, VkDeviceSize bytes) {
  const VkBufferCopy region{0, 0, bytes};
  vkCmdCopyBuffer(commands_, from, to, 1, &region);
}

void Batch::upload_bytes(const RawBuffer& to, std::span<const std::byte> bytes) {
  check(bytes.size() <= to.bytes(), "upload larger than its buffer");
  if (bytes.empty()) return;
  std::byte* target = to.mapped();
  if (!target) {
    const RawBuffer& staged = stage(bytes.size(), Memory::upload, to);
    target = staged.mapped();
    copy_bytes(staged.get(), to.get(), bytes.size());
  }
  std::memcpy(target, bytes.data(), bytes.size());
}

void Batch::download_bytes(const RawBuffer& from, std::span<std::byte> to) {
  check(to.size() <= from.bytes(), "download larger than its buffer");
  if (to.empty()) return;
  const std::byte* source = from.mapped();
  if (!source) {
    const RawBuffer& staged = stage(to.size(), Memory::download, from);
    source = staged.mapped();
    barrier();
    copy_bytes(from.get(), staged.get(), to.size());
  }
  downloads_.push_back({source, to});
}

void Batch::fill(const RawBuffer& buffer, std::uint32_t word) {
  vkCmdFillBuffer(commands_, buffer.get(), 0, VK_WHOLE_SIZE, word);
}

void Batch::copy(const RawBuffer& from, const RawBuffer& to) {
  check(from.bytes() <= to.bytes(), "copy into a smaller buffer");
  copy_bytes(from.get(), to.get(), from.bytes());
}

void Batch::barrier() { memory_barrier(commands_, any_access, any_stage); }

void Batch::check_dispatch(const Kernel& kernel, Groups groups, std::span<const Bound> bound) const {
  check(bound.size() == kernel.bindings(), "a dispatch binds as many buffers as its kernel declares");
  check(bound.size() <= bindings_per_set, "more buffers than a descriptor pool is made for");
  const std::uint32_t* most = device_.limits().maxComputeWorkGroupCount;
  if (groups.x > most[0] || groups.y > most[1] || groups.z > most[2])
    throw GpuError(described(kernel, groups) + ": more workgroups than " + device_.info().name + " takes");
  for (const Bound& range : bound)
    device_.check_range(range.bytes, kernel.name() + ": buffer '" + range.buffer->name() + "'");
}

VkDescriptorSet Batch::bind(const Kernel& kernel, std::span<const Bound> bound) {
  if (sets_left_ == 0) {
    descriptor_pools_.push_back(create_descriptor_pool(device_));
    sets_left_ = sets_per_pool;
  }
  --sets_left_;
  const VkDescriptorSetLayout layout = kernel.set_layout();
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = descriptor_pools_.back().get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  require(vkAllocateDescriptorSets(device_.get(), &info, &set), kernel.name() + ": vkAllocateDescriptorSets");

  VkDescriptorBufferInfo ranges[bindings_per_set];
  VkWriteDescriptorSet writes[bindings_per_set];
  for (std::uint32_t i = 0; i < bound.size(); ++i) {
    ranges[i] = {bound[i].buffer->get(), bound[i].offset, bound[i].bytes};
    writes[i] = {};
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &ranges[i];
  }
  vkUpdateDescriptorSets(device_.get(), static_cast<std::uint32_t>(bound.size()), writes, 0, nullptr);
  return set;
}

void Batch::dispatch_bytes(const Kernel& kernel, Groups groups, std::span<const Bound> bound,
                           std::span<const std::byte> push) {
  if (groups.x == 0 || groups.y == 0 || groups.z == 0) return;
  check(push.size() == kernel.push_bytes(), "push constants of another kernel");
  check_dispatch(kernel, groups, bound);
  story_ += (story_.empty() ? "" : ", ") + described(kernel, groups);
  const VkDescriptorSet set = bind(kernel, bound);
  vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline());
  vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.layout(), 0, 1, &set, 0, nullptr);
  vkCmdPushConstants(commands_, kernel.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                     static_cast<std::uint32_t>(push.size()), push.data());
  write_timestamp(0);
  vkCmdDispatch(commands_, groups.x, groups.y, groups.z);
  write_timestamp(1);
  dispatched_.push_back(kernel.name());
}

// Before (0) or after (1) the dispatch that comes next.
void Batch::write_timestamp(std::uint32_t which) {
  if (device_.seconds_per_tick() == 0) return;
  const auto number = static_cast<std::uint32_t>(dispatched_.size() % timed_per_pool);
  if (which == 0 && number == 0) {
    query_pools_.push_back(create_queries(device_));
    vkCmdResetQueryPool(commands_, query_pools_.back().get(), 0, 2 * timed_per_pool);
  }
  vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, query_pools_.back().get(),
                      2 * number + which);
}

std::vector<StageTime> Batch::read_times() const {
  std::vector<StageTime> times;
  for (std::size_t p = 0; p < query_pools_.size(); ++p) {
    const std::span<const std::string> names =
        std::span(dispatched_)
            .subspan(p * timed_per_pool)
            .first(std::min<std::size_t>(timed_per_pool, dispatched_.size() - p * timed_per_pool));
    std::vector<std::uint64_t> ticks(2 * names.size());
    require(vkGetQueryPoolResults(device_.get(), query_pools_[p].get(), 0,
                                  static_cast<std::uint32_t>(ticks.size()), ticks.size() * sizeof ticks[0],
                                  ticks.data(), sizeof ticks[0], VK_QUERY_RESULT_64_BIT),
            name_ + ": vkGetQueryPoolResults");
    for (std::size_t i = 0; i < names.size(); ++i) {
      auto row = std::ranges::find(times, names[i], &StageTime::name);
      if (row == times.end()) row = times.insert(row, StageTime{names[i], 0, 0});
      row->seconds += device_.seconds_between(ticks[2 * i], ticks[2 * i + 1]);
      ++row->calls;
    }
  }
  return times;
}

std::vector<StageTime> Batch::run() {
  const std::string what = name_ + " (" + story_ + ")";
  memory_barrier(commands_, VK_ACCESS_HOST_READ_BIT, VK_PIPELINE_STAGE_HOST_BIT);
  require(vkEndCommandBuffer(commands_), what + ": vkEndCommandBuffer");
  const Handle<VkFence> done = create_fence(device_);
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands_;
  const VkFence fence = done.get();
  require(vkQueueSubmit(device_.queue(), 1, &info, fence), what + ": vkQueueSubmit");
  require(vkWaitForFences(device_.get(), 1, &fence, VK_TRUE, UINT64_MAX), what + ": vkWaitForFences");
  for (const Download& download : downloads_)
    std::memcpy(download.to.data(), download.from, download.to.size());
  return read_times();
}

}  // namespace edgescout::gpu
