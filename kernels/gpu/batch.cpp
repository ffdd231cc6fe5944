#include "kernels/gpu/batch.h"

#include <algorithm>
#include <cstring>

#include "kernels/error.h"
#include "kernels/gpu/result.h"

namespace edgescout::gpu {

namespace {

constexpr VkAccessFlags any_write = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
constexpr VkAccessFlags any_access =
    any_write | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;
constexpr VkPipelineStageFlags any_stage =
    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;

void memory_barrier(VkCommandBuffer commands, VkAccessFlags to, VkPipelineStageFlags stages) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = any_write;
  barrier.dstAccessMask = to;
  vkCmdPipelineBarrier(commands, any_stage, stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

std::string described(const Kernel& kernel, Groups groups) {
  return kernel.name() + " " + std::to_string(groups.x) + "x" + std::to_string(groups.y) + "x" +
         std::to_string(groups.z);
}

}  // namespace

Batch::Batch(const Device& device, std::string name)
    : device_(device), name_(std::move(name)), set_(device.command_sets().take()) {}

Batch::~Batch() {
  // A wait may fail, for want of memory, while the device works on: nothing is given back under its
  // hands.
  if (is_running_)
    vkDeviceWaitIdle(device_.get());
  else
    device_.command_sets().give_back(std::move(set_));
}

const RawBuffer& Batch::stage(VkDeviceSize bytes, Memory memory, const RawBuffer& other_end) {
  staging_.emplace_back(device_, bytes, memory, "staging for " + other_end.name());
  return staging_.back();
}

void Batch::copy_bytes(VkBuffer from, VkBuffer to, VkDeviceSize bytes) {
  const VkBufferCopy region{0, 0, bytes};
  vkCmdCopyBuffer(set_.commands, from, to, 1, &region);
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
  device_.work().bytes_up += bytes.size();
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
  device_.work().bytes_down += to.size();
}

void Batch::fill(const RawBuffer& buffer, VkDeviceSize bytes, std::uint32_t word) {
  check(bytes <= buffer.bytes(), "fill larger than its buffer");
  if (bytes == 0) return;
  vkCmdFillBuffer(set_.commands, buffer.get(), 0, bytes, word);
  device_.work().bytes_filled += bytes;
}

void Batch::copy(const RawBuffer& from, const RawBuffer& to) {
  check(from.bytes() <= to.bytes(), "copy into a smaller buffer");
  copy_bytes(from.get(), to.get(), from.bytes());
}

void Batch::barrier() { memory_barrier(set_.commands, any_access, any_stage); }

void Batch::check_dispatch(const Kernel& kernel, Groups groups,
                           std::span<const Bound> bound) const {
  check(bound.size() == kernel.bindings(),
        "a dispatch binds as many buffers as its kernel declares");
  check(bound.size() <= BINDINGS_PER_SET, "more buffers than a descriptor pool is made for");
  for (std::uint32_t i = 0; i < bound.size(); ++i)
    check(!kernel.is_texel(i) || bound[i].texels != VK_NULL_HANDLE, "a buffer without texels");
  const std::uint32_t* most = device_.limits().maxComputeWorkGroupCount;
  if (groups.x > most[0] || groups.y > most[1] || groups.z > most[2])
    throw GpuError(described(kernel, groups) + ": more workgroups than " + device_.info().name +
                   " takes");
  for (const Bound& range : bound)
    device_.check_range(range.bytes, kernel.name() + ": buffer '" + range.buffer->name() + "'");
}

VkDescriptorSet Batch::bind(const Kernel& kernel, std::span<const Bound> bound) {
  const std::size_t pool = sets_++ / SETS_PER_POOL;
  if (pool == set_.descriptors.size()) set_.descriptors.push_back(create_descriptors(device_));
  VkDescriptorSetLayout layout = kernel.set_layout();
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = set_.descriptors[pool].get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  require(vkAllocateDescriptorSets(device_.get(), &info, &set),
          kernel.name() + ": vkAllocateDescriptorSets");

  VkDescriptorBufferInfo ranges[BINDINGS_PER_SET];
  VkWriteDescriptorSet writes[BINDINGS_PER_SET];
  for (std::uint32_t i = 0; i < bound.size(); ++i) {
    ranges[i] = {bound[i].buffer->get(), bound[i].offset, bound[i].bytes};
    writes[i] = {};
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    if (kernel.is_texel(i)) {
      writes[i].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
      writes[i].pTexelBufferView = &bound[i].texels;
    } else {
      writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      writes[i].pBufferInfo = &ranges[i];
    }
  }
  vkUpdateDescriptorSets(device_.get(), static_cast<std::uint32_t>(bound.size()), writes, 0,
                         nullptr);
  return set;
}

void Batch::dispatch_bytes(const Kernel& kernel, Groups groups, std::span<const Bound> bound,
                           std::span<const std::byte> push) {
  if (groups.x == 0 || groups.y == 0 || groups.z == 0) return;
  check(push.size() == kernel.push_bytes(), "push constants of another kernel");
  check_dispatch(kernel, groups, bound);
  story_ += (story_.empty() ? "" : ", ") + described(kernel, groups);
  VkDescriptorSet set = bind(kernel, bound);
  vkCmdBindPipeline(set_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline());
  vkCmdBindDescriptorSets(set_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.layout(), 0, 1,
                          &set, 0, nullptr);
  vkCmdPushConstants(set_.commands, kernel.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                     static_cast<std::uint32_t>(push.size()), push.data());
  write_timestamp(0);
  vkCmdDispatch(set_.commands, groups.x, groups.y, groups.z);
  write_timestamp(1);
  ++device_.work().dispatches;
  dispatched_.push_back(kernel.name());
}

// Before (0) or after (1) the dispatch that comes next.
void Batch::write_timestamp(std::uint32_t which) {
  if (!device_.times_kernels()) return;
  const std::size_t pool = dispatched_.size() / TIMED_PER_POOL;
  const auto number = static_cast<std::uint32_t>(dispatched_.size() % TIMED_PER_POOL);
  if (pool == set_.queries.size()) set_.queries.push_back(create_queries(device_));
  VkQueryPool queries = set_.queries[pool].get();
  if (which == 0 && number == 0) vkCmdResetQueryPool(set_.commands, queries, 0, 2 * TIMED_PER_POOL);
  vkCmdWriteTimestamp(set_.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries,
                      2 * number + which);
}

std::vector<StageTime> Batch::read_times() const {
  std::vector<StageTime> times;
  if (!device_.times_kernels()) return times;
  for (std::size_t p = 0; p * TIMED_PER_POOL < dispatched_.size(); ++p) {
    const std::span<const std::string> names =
        std::span(dispatched_)
            .subspan(p * TIMED_PER_POOL)
            .first(std::min<std::size_t>(TIMED_PER_POOL, dispatched_.size() - p * TIMED_PER_POOL));
    std::vector<std::uint64_t> ticks(2 * names.size());
    require(vkGetQueryPoolResults(device_.get(), set_.queries[p].get(), 0,
                                  static_cast<std::uint32_t>(ticks.size()),
                                  ticks.size() * sizeof ticks[0], ticks.data(), sizeof ticks[0],
                                  VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
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
  memory_barrier(set_.commands, VK_ACCESS_HOST_READ_BIT, VK_PIPELINE_STAGE_HOST_BIT);
  require(vkEndCommandBuffer(set_.commands), what + ": vkEndCommandBuffer");
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &set_.commands;
  VkFence fence = set_.fence.get();
  is_running_ = true;
  require(vkQueueSubmit(device_.queue(), 1, &info, fence), what + ": vkQueueSubmit");
  ++device_.work().submits;
  require(vkWaitForFences(device_.get(), 1, &fence, VK_TRUE, UINT64_MAX),
          what + ": vkWaitForFences");
  is_running_ = false;
  for (const Download& download : downloads_)
    std::memcpy(download.to.data(), download.from, download.to.size());
  return read_times();
}

}  // namespace edgescout::gpu
