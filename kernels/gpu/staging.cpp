#include "kernels/gpu/staging.h"

#include <algorithm>
#include <bit>

namespace edgescout::gpu {

namespace {

constexpr VkDeviceSize smallest = VkDeviceSize{64} << 10;
constexpr VkDeviceSize largest_kept = VkDeviceSize{64} << 20;  // what batches cut their copies to
constexpr VkDeviceSize most_kept = VkDeviceSize{256} << 20;    // of all together

}  // namespace

RawBuffer StagingPool::take(VkDeviceSize bytes, Memory memory, const std::string& name) {
  const auto fits = [&](const RawBuffer& b) { return b.memory() == memory && b.bytes() >= bytes; };
  auto best = free_.end();
  for (auto it = free_.begin(); it != free_.end(); ++it)
    if (fits(*it) && (best == free_.end() || it->bytes() < best->bytes())) best = it;
  if (best == free_.end())
    return RawBuffer(device_,
                     bytes > largest_kept ? bytes : std::max(smallest, std::bit_ceil(bytes)),
                     memory, name);
  RawBuffer buffer = std::move(*best);
  free_.erase(best);
  free_bytes_ -= buffer.bytes();
  return buffer;
}

void StagingPool::give_back(RawBuffer buffer) {
  if (buffer.bytes() > largest_kept) return;
  free_bytes_ += buffer.bytes();
  free_.push_back(std::move(buffer));
  while (free_bytes_ > most_kept) {
    free_bytes_ -= free_.front().bytes();
    free_.erase(free_.begin());
  }
}

}  // namespace edgescout::gpu
