#include "kernels/gpu/staging.h"

#include <algorithm>
#include <bit>

namespace edgescout::gpu {

namespace {

constexpr VkDeviceSize smallest = VkDeviceSize{64} << 10;
constexpr VkDeviceSize largest_kept = VkDeviceSize{16} << 20;
constexpr std::size_t most_kept = 16;

}  // namespace

RawBuffer StagingPool::take(VkDeviceSize bytes, Memory memory, const std::string& name) {
  const auto fits = [&](const RawBuffer& b) { return b.memory() == memory && b.bytes() >= bytes; };
  auto best = free_.end();
  for (auto it = free_.begin(); it != free_.end(); ++it)
    if (fits(*it) && (best == free_.end() || it->bytes() < best->bytes())) best = it;
  if (best == free_.end())
    return RawBuffer(device_, bytes > largest_kept ? bytes : std::max(smallest, std::bit_ceil(bytes)), memory,
                     name);
  RawBuffer buffer = std::move(*best);
  free_.erase(best);
  return buffer;
}

void StagingPool::give_back(RawBuffer buffer) {
  if (buffer.bytes() > largest_kept) return;
  if (free_.size() == most_kept) free_.erase(free_.begin());
  free_.push_back(std::move(buffer));
}

}  // namespace edgescout::gpu
