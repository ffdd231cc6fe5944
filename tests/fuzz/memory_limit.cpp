#include "tests/fuzz/memory_limit.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define EDGESCOUT_COUNTS_MEMORY
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define EDGESCOUT_COUNTS_MEMORY
#endif

#ifdef EDGESCOUT_COUNTS_MEMORY

#include <sanitizer/common_interface_defs.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <limits>

// Of sanitizer/allocator_interface.h. GCC has the functions without the header.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*of_new)(const volatile void*,
                                                                        std::size_t),
                                                         void (*of_freed)(const volatile void*));
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* memory);

namespace edgescout::test {

const bool counts_memory = true;

namespace {

constexpr std::ptrdiff_t no_limit = std::numeric_limits<std::ptrdiff_t>::max();
std::atomic<std::ptrdiff_t> held{0}, limit_bytes{no_limit};

void count_new(const volatile void*, std::size_t size) {
  if ((held += static_cast<std::ptrdiff_t>(size)) <= limit_bytes) return;
  limit_bytes = no_limit;  // for what follows allocates, too
  std::fprintf(stderr, "ERROR: more memory than 64 bytes a byte and 64 MiB, by %zu bytes at once\n",
               size);
  __sanitizer_print_stack_trace();
  std::abort();
}

void count_freed(const volatile void* memory) {
  held -= static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(memory));
}

}  // namespace

MemoryLimit::MemoryLimit(std::size_t bytes) {
  static const int hooks = __sanitizer_install_malloc_and_free_hooks(count_new, count_freed);
  if (hooks == 0) std::abort();
  held = 0;
  limit_bytes = static_cast<std::ptrdiff_t>(bytes);
}

MemoryLimit::~MemoryLimit() { limit_bytes = no_limit; }

}  // namespace edgescout::test

#else

namespace edgescout::test {

const bool counts_memory = false;
MemoryLimit::MemoryLimit(std::size_t) {}
MemoryLimit::~MemoryLimit() = default;

}  // namespace edgescout::test

#endif
