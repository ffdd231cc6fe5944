// Device memory with a name, from the device's store. On a device with unified memory the host sees
// it; elsewhere Batch copies through staging.
#pragma once

#include <cstddef>
#include <string>

#include <vulkan/vulkan.h>

#include "kernels/gpu/buffer_store.h"
#include "kernels/gpu/device.h"
#include "kernels/gpu/handle.h"

namespace edgescout::gpu {

class RawBuffer {
 public:
  RawBuffer() = default;
  // Throws GpuError naming buffer and size where the memory is not to be had, OutOfDeviceMemory
  // where it is at another time. At least 4 bytes are allocated.
  RawBuffer(const Device& device, VkDeviceSize bytes, Memory memory, std::string name);

  VkBuffer get() const { return lease_ ? lease_->buffer.get() : VK_NULL_HANDLE; }
  VkDeviceSize bytes() const { return bytes_; }
  const std::string& name() const { return name_; }
  // Null where the host cannot see the memory.
  std::byte* mapped() const { return lease_ ? lease_->mapped : nullptr; }

 private:
  std::string name_;
  VkDeviceSize bytes_ = 0;
  BufferStore::Lease lease_;
};

// Room for `size` values of T.
template <class T>
class Buffer : public RawBuffer {
 public:
  Buffer() = default;
  Buffer(const Device& device, std::size_t size, std::string name, Memory memory = Memory::device)
      : RawBuffer(device, size * sizeof(T), memory, std::move(name)), size_(size) {}
  std::size_t size() const { return size_; }
  // Grows to at least `size` values; the contents are lost when it does. Throws GpuError, and stays
  // as it is, where a kernel could not be given all of it: a dispatch binds such a buffer whole.
  void reserve(const Device& device, std::size_t size, const char* name) {
    if (size > size_ || get() == VK_NULL_HANDLE) {
      device.check_range(size * sizeof(T), "buffer '" + std::string(name) + "'");
      *this = Buffer();
      *this = Buffer(device, size, name);
    }
  }

 private:
  std::size_t size_ = 0;
};

// Words that kernels may also read through a uniform texel buffer, which some devices do faster:
// at most limits().maxTexelBufferElements.
class TexelBuffer : public Buffer<std::uint32_t> {
 public:
  void reserve(const Device& device, std::size_t size, const char* name);
  VkBufferView view() const { return view_.get(); }

 private:
  Handle<VkBufferView> view_;
};

}  // namespace edgescout::gpu
