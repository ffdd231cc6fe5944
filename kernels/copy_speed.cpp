#include "kernels/copy_speed.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <vector>

#include "kernels/backend.h"
#include "kernels/thread_pool.h"
#ifdef EDGESCOUT_VULKAN
#include "kernels/gpu/copy_speed.h"
#endif

namespace edgescout {

namespace {

constexpr std::size_t BLOCK_BYTES = std::size_t{256} << 20;
constexpr int REPETITIONS = 5;

double cpu_copy_bytes_per_s(ThreadPool& pool) {
  const std::vector<char> from(BLOCK_BYTES, 1);
  std::vector<char> to(BLOCK_BYTES, 0);
  const std::size_t parts = static_cast<std::size_t>(pool.threads()), part = BLOCK_BYTES / parts;
  double best_s = 1e30;
  for (int i = 0; i < REPETITIONS; ++i) {
    const auto start = std::chrono::steady_clock::now();
    pool.for_each(parts, [&](std::size_t p) {
      std::memcpy(to.data() + p * part, from.data() + p * part, part);
    });
    best_s = std::min(
        best_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 2.0 * static_cast<double>(parts * part) / best_s;
}

}  // namespace

double copy_bytes_per_s(const std::string& choice) {
  const std::unique_ptr<Backend> backend = make_backend(choice);
#ifdef EDGESCOUT_VULKAN
  if (backend->is_gpu()) {
    const std::string name = backend->name();  // "vulkan:INDEX .."
    return gpu::copy_bytes_per_s(std::stoi(name.substr(name.find(':') + 1)));
  }
#endif
  return cpu_copy_bytes_per_s(backend->threads());
}

}  // namespace edgescout
