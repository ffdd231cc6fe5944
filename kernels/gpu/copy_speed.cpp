#include "kernels/gpu/copy_speed.h"

#include <algorithm>
#include <chrono>

#include "kernels/gpu/batch.h"

namespace edgescout::gpu {

double copy_bytes_per_s(int device_index) {
  constexpr VkDeviceSize WANTED_BYTES = VkDeviceSize{256} << 20;
  constexpr int COPIES = 8, REPETITIONS = 5;  // many a batch: its submission must not count
  DeviceOptions options;
  options.index = device_index;
  const Device device(options);
  const VkDeviceSize bytes = std::min(WANTED_BYTES, device.max_allocation_bytes());
  const RawBuffer from(device, bytes, Memory::device, "copied from"),
      to(device, bytes, Memory::device, "copied to");
  double best_s = 1e30;
  for (int i = 0; i <= REPETITIONS; ++i) {
    Batch batch(device, "copy");
    batch.fill(from, bytes / 4 * 4, static_cast<std::uint32_t>(i));
    batch.barrier();
    batch.run();
    Batch copies(device, "copies");
    for (int c = 0; c < COPIES; ++c) {
      copies.copy(from, to);
      copies.barrier();
    }
    const auto start = std::chrono::steady_clock::now();
    copies.run();
    if (i > 0)
      best_s = std::min(
          best_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 2.0 * COPIES * static_cast<double>(bytes) / best_s;
}

}  // namespace edgescout::gpu
