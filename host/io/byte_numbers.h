// Internal to host/io: numbers in the header of a binary file, in either order of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace edgescout {

struct ByteNumbers {
  std::string_view bytes;
  bool big_endian = true;

  // Of `size` bytes, 1 to 8. What lies beyond the end counts as 0.
  std::uint64_t at(std::size_t place, std::size_t size) const {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t from = place + (big_endian ? i : size - 1 - i);
      const unsigned byte = from < bytes.size() ? static_cast<unsigned char>(bytes[from]) : 0;
      number = 256 * number + byte;
    }
    return number;
  }
};

}  // namespace edgescout
