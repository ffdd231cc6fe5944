#include "kernels/cpu_handles.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace edgescout {

TensorMemory::~TensorMemory() {
  for (const Block block : free_) std::free(block.data());
}

TensorMemory::Block TensorMemory::take(std::size_t size) {
  const std::lock_guard lock(mutex_);
  const auto fits = [&](Block block) { return block.size() == size; };
  if (const auto found = std::ranges::find_if(free_, fits); found != free_.end()) {
    const Block block = *found;
    free_.erase(found);
    return block;
  }
  constexpr std::size_t page = std::size_t{2} << 20;
  const std::size_t bytes = (size * sizeof(std::uint16_t) + page - 1) / page * page;
  void* memory = std::aligned_alloc(page, bytes);
  if (!memory) throw std::bad_alloc();
#ifdef __linux__
  madvise(memory, bytes, MADV_HUGEPAGE);
#endif
  return {static_cast<std::uint16_t*>(memory), size};
}

void TensorMemory::give_back(Block block) {
  const std::lock_guard lock(mutex_);
  constexpr std::size_t kept = 2;
  if (free_.size() >= kept) {
    std::free(free_.front().data());
    free_.erase(free_.begin());
  }
  free_.push_back(block);
}

}  // namespace edgescout
