#include "kernels/gpu/buffer.h"

#include <algorithm>

#include "kernels/gpu/result.h"

namespace edgescout::gpu {

RawBuffer::RawBuffer(const Device& device, VkDeviceSize bytes, Memory memory, std::string name)
    : name_(std::move(name)),
      bytes_(std::max<VkDeviceSize>(bytes, 4)),
      lease_(device.buffers().take(
          bytes_, memory, "buffer '" + name_ + "' of " + std::to_string(bytes_) + " bytes")) {}

void TexelBuffer::reserve(const Device& device, std::size_t size, const char* name) {
  if (size <= this->size() && view() != VK_NULL_HANDLE) return;
  view_ = {};
  Buffer::reserve(device, size, name);
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = get();
  info.format = VK_FORMAT_R32_UINT;
  info.range = bytes();
  VkBufferView view = VK_NULL_HANDLE;
  require(vkCreateBufferView(device.get(), &info, nullptr, &view),
          "vkCreateBufferView for buffer '" + this->name() + "'");
  view_ = {device.get(), view, vkDestroyBufferView};
}

}  // namespace edgescout::gpu
