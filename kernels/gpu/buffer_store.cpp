#include "kernels/gpu/buffer_store.h"

#include <algorithm>
#include <bit>

#include "kernels/gpu/device.h"
#include "kernels/gpu/result.h"

namespace edgescout::gpu {

namespace {

constexpr VkMemoryPropertyFlags host_coherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkDeviceSize MIB = VkDeviceSize{1} << 20;

std::uint32_t type_of(const Device& device, std::uint32_t allowed, Memory memory) {
  constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                  cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  switch (memory) {
    case Memory::device:
      return device.memory_type(
          allowed, device.unified_memory() ? local | cached | host_coherent : local, 0);
    case Memory::upload:
      return device.memory_type(allowed, host_coherent, 0);
    case Memory::download:  // cached memory is read faster, but no device must have it
      return device.memory_type(allowed, host_coherent, cached);
  }
  throw LogicError("unknown kind of memory");
}

VkBuffer create_buffer(VkDevice device, VkDeviceSize bytes, const std::string& what) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  require(vkCreateBuffer(device, &info, nullptr, &buffer), "vkCreateBuffer for " + what);
  return buffer;
}

VkDeviceMemory allocate_memory(const Device& device, const VkMemoryRequirements& needs,
                               Memory memory, const std::string& what) {
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = type_of(device, needs.memoryTypeBits, memory);
  VkDeviceMemory allocated = VK_NULL_HANDLE;
  const VkResult result = vkAllocateMemory(device.get(), &info, nullptr, &allocated);
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
    throw OutOfDeviceMemory("vkAllocateMemory for " + what + ": " + result_name(result));
  require(result, "vkAllocateMemory for " + what);
  ++device.work().allocations;
  return allocated;
}

std::unique_ptr<Allocation> allocate(const Device& device, VkDeviceSize bytes, Memory kind,
                                     const std::string& what) {
  auto made = std::make_unique<Allocation>();
  made->bytes = bytes;
  made->kind = kind;
  made->buffer = {device.get(), create_buffer(device.get(), bytes, what), vkDestroyBuffer};
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.get(), made->buffer.get(), &needs);
  made->memory = {device.get(), allocate_memory(device, needs, kind, what), vkFreeMemory};
  if (kind == Memory::device) made->counted = CountedMemory(needs.size);
  require(vkBindBufferMemory(device.get(), made->buffer.get(), made->memory.get(), 0),
          "vkBindBufferMemory for " + what);
  if (kind == Memory::device && !device.unified_memory()) return made;
  void* address = nullptr;
  require(vkMapMemory(device.get(), made->memory.get(), 0, VK_WHOLE_SIZE, 0, &address),
          "vkMapMemory for " + what);
  made->mapped = static_cast<std::byte*>(address);
  return made;
}

// Room to grow: what the next image needs differs a little.
VkDeviceSize with_room(VkDeviceSize bytes, VkDeviceSize most) {
  constexpr VkDeviceSize smallest = 4096;
  const VkDeviceSize step = std::clamp(std::bit_floor(bytes) / 8, smallest, MIB);
  return std::max(bytes, std::min((bytes + step - 1) / step * step, most));
}

}  // namespace

BufferStore::BufferStore(const Device& device)
    : device_(device),
      most_free_bytes_(std::min<VkDeviceSize>(512 * MIB, device.info().memory_bytes / 4)) {}

BufferStore::Lease BufferStore::take(VkDeviceSize bytes, Memory kind, const std::string& what) {
  const VkDeviceSize most = device_.max_allocation_bytes();
  if (bytes > most)
    throw GpuError(what + ": " + device_.info().name + " allocates at most " +
                   std::to_string(most) + " bytes at once");
  std::unique_ptr<Allocation> taken = take_free(bytes, kind);
  if (!taken) {
    try {
      taken = allocate(device_, with_room(bytes, most), kind, what);
    } catch (const OutOfDeviceMemory&) {
      if (!drop_free()) throw;
      taken = allocate(device_, bytes, kind, what);
    }
  }
  return {taken.release(), GiveBack{this}};
}

std::unique_ptr<Allocation> BufferStore::take_free(VkDeviceSize bytes, Memory kind) {
  const std::lock_guard lock(mutex_);
  constexpr VkDeviceSize any = 64 << 10;  // so short that it does not matter
  auto best = free_.end();
  for (auto it = free_.begin(); it != free_.end(); ++it) {
    const VkDeviceSize size = (*it)->bytes;
    const bool fits = (*it)->kind == kind && size >= bytes && size <= std::max(any, bytes / 4 * 5);
    if (fits && (best == free_.end() || size < (*best)->bytes)) best = it;
  }
  if (best == free_.end()) return nullptr;
  std::unique_ptr<Allocation> taken = std::move(*best);
  free_.erase(best);
  free_bytes_ -= taken->bytes;
  return taken;
}

bool BufferStore::drop_free() {
  const std::lock_guard lock(mutex_);
  const bool were_some = !free_.empty();
  free_.clear();
  free_bytes_ = 0;
  return were_some;
}

void BufferStore::give_back(Allocation* allocation) {
  std::unique_ptr<Allocation> returned(allocation);
  if (returned->bytes > most_free_bytes_) return;
  const std::lock_guard lock(mutex_);
  free_bytes_ += returned->bytes;
  free_.push_back(std::move(returned));
  auto kept = free_.begin();
  for (; free_bytes_ > most_free_bytes_; ++kept) free_bytes_ -= (*kept)->bytes;
  free_.erase(free_.begin(), kept);
}

}  // namespace edgescout::gpu
