#include "kernels/device_memory.h"

#include <algorithm>
#include <mutex>

namespace edgescout {

namespace {

std::mutex mutex;
std::uint64_t held = 0, peak = 0;

}  // namespace

CountedMemory::CountedMemory(std::uint64_t bytes) : bytes_(bytes) {
  const std::lock_guard lock(mutex);
  held += bytes;
  peak = std::max(peak, held);
}

CountedMemory::~CountedMemory() {
  const std::lock_guard lock(mutex);
  held -= bytes_;
}

std::uint64_t peak_device_memory_bytes() {
  const std::lock_guard lock(mutex);
  return peak;
}

void forget_peak_device_memory() {
  const std::lock_guard lock(mutex);
  peak = held;
}

}  // namespace edgescout
