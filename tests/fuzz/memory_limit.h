// Ends the process where it holds more memory than is allowed. Works under the address sanitizer;
// elsewhere it does nothing.
#pragma once

#include <cstddef>

namespace edgescout::test {

extern const bool counts_memory;  // under the address sanitizer

// Limits what the process allocates and does not free while the object lives.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::size_t bytes);
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;
  ~MemoryLimit();
};

}  // namespace edgescout::test
