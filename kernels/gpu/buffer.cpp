#include "kernels/gpu/buffer.h"

#include <algorithm>

#include "kernels/error.h"
#include "kernels/gpu/result.h"

namespace edgescout::gpu {

namespace {

constexpr VkMemoryPropertyFlags host_coherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

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

VkDeviceMemory allocate(const Device& device, const VkMemoryRequirements& needs, Memory memory,
                        const std::string& what) {
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

}  // namespace

RawBuffer::RawBuffer(const Device& device, VkDeviceSize bytes, Memory memory, std::string name)
    : name_(std::move(name)), bytes_(std::max<VkDeviceSize>(bytes, 4)), kind_(memory) {
  const std::string what = "buffer '" + name_ + "' of " + std::to_string(bytes_) + " bytes";
  if (bytes_ > device.max_allocation_bytes())
    throw GpuError(what + ": " + device.info().name + " allocates at most " +
                   std::to_string(device.max_allocation_bytes()) + " bytes at once");
  buffer_ = {device.get(), create_buffer(device.get(), bytes_, what), vkDestroyBuffer};
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.get(), get(), &needs);
  memory_ = {device.get(), allocate(device, needs, memory, what), vkFreeMemory};
  if (memory == Memory::device) counted_ = CountedMemory(needs.size);
  require(vkBindBufferMemory(device.get(), get(), memory_.get(), 0),
          "vkBindBufferMemory for " + what);
  if (memory == Memory::device && !device.unified_memory()) return;
  void* address = nullptr;
  require(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &address),
          "vkMapMemory for " + what);
  mapped_ = static_cast<std::byte*>(address);
}

void TexelBuffer::reserve(const Device& device, std::size_t size, const char* name) {
  if (size <= this->size() && view() != VK_NULL_HANDLE) return;
  view_ = {};
  Buffer::reserve(device, size, name);
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = get();
  info.format = VK_FORMAT_R32_UINT;
  info.range = VK_WHOLE_SIZE;
  VkBufferView view = VK_NULL_HANDLE;
  require(vkCreateBufferView(device.get(), &info, nullptr, &view),
          "vkCreateBufferView for buffer '" + this->name() + "'");
  view_ = {device.get(), view, vkDestroyBufferView};
}

}  // namespace edgescout::gpu
