// Host-visible buffers kept for the next copy: on a discrete card allocating one costs more than
// most copies do.
#pragma once

#include <vector>

#include "kernels/gpu/buffer.h"

namespace edgescout::gpu {

class StagingPool {
 public:
  explicit StagingPool(const Device& device) : device_(device) {}
  // At least `bytes` long, Memory::upload or Memory::download.
  RawBuffer take(VkDeviceSize bytes, Memory memory, const std::string& name);
  // For the next taker; larger ones than 64 MiB, and the oldest beyond 256 MiB in all, are freed.
  void give_back(RawBuffer buffer);

 private:
  const Device& device_;
  std::vector<RawBuffer> free_;  // oldest first
  VkDeviceSize free_bytes_ = 0;
};

}  // namespace edgescout::gpu
