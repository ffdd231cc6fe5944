// Buffers and their memory, kept for the next taker: to allocate costs a driver more than most
// kernels take, and images of one size need the same again and again.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "kernels/device_memory.h"
#include "kernels/error.h"
#include "kernels/gpu/handle.h"

namespace edgescout::gpu {

class Device;

// The device has the memory, but others hold it.
class OutOfDeviceMemory : public GpuError {
 public:
  using GpuError::GpuError;
};

enum class Memory {
  device,    // read and written by kernels
  upload,    // host writes, device copies from it
  download,  // device copies to it, host reads
};

struct Allocation {
  VkDeviceSize bytes = 0;
  Memory kind = Memory::device;
  CountedMemory counted;
  Handle<VkDeviceMemory> memory;  // freed after the buffer bound to it
  Handle<VkBuffer> buffer;
  std::byte* mapped = nullptr;  // null where the host cannot see it
};

class BufferStore {
 public:
  struct GiveBack {
    BufferStore* store = nullptr;
    void operator()(Allocation* allocation) const { store->give_back(allocation); }
  };
  using Lease = std::unique_ptr<Allocation, GiveBack>;

  explicit BufferStore(const Device& device);
  // At least `bytes` long; its contents are anything. Throws GpuError naming `what` where the
  // memory is not to be had, OutOfDeviceMemory where it is at another time.
  Lease take(VkDeviceSize bytes, Memory kind, const std::string& what);

 private:
  // The oldest beyond the bound are freed.
  void give_back(Allocation* allocation);
  // Of those that `bytes` fill to four fifths the smallest; null where there is none.
  std::unique_ptr<Allocation> take_free(VkDeviceSize bytes, Memory kind);
  // Whether there were some.
  bool drop_free();

  const Device& device_;
  std::mutex mutex_;  // views are given back by whichever thread drops them; guards what follows
  VkDeviceSize most_free_bytes_, free_bytes_ = 0;
  std::vector<std::unique_ptr<Allocation>> free_;  // oldest first
};

}  // namespace edgescout::gpu
