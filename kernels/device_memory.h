// How much memory of Vulkan devices this process holds, and held at most. On a device with unified
// memory it is the host's.
#pragma once

#include <cstdint>
#include <utility>

namespace edgescout {

// Counts its bytes for as long as it lives.
class CountedMemory {
 public:
  CountedMemory() = default;
  explicit CountedMemory(std::uint64_t bytes);
  CountedMemory(CountedMemory&& other) noexcept : bytes_(std::exchange(other.bytes_, 0)) {}
  CountedMemory& operator=(CountedMemory&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~CountedMemory();

 private:
  std::uint64_t bytes_ = 0;
};

// Since the last call of forget_peak_device_memory(). Of all devices and threads together.
std::uint64_t peak_device_memory_bytes();
void forget_peak_device_memory();

}  // namespace edgescout
