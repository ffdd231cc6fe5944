// A matrix of bits, for example which candidates a combination holds or which pairs can coexist.
#pragma once

#include <cstdint>
#include <vector>

namespace edgescout {

// Column c of a row is bit c % 32 of word c / 32. Every row starts at a word. Bits beyond the
// columns are zero.
struct BitMatrix {
  std::uint32_t rows = 0, columns = 0;
  std::vector<std::uint32_t> words;

  BitMatrix() = default;
  BitMatrix(std::size_t row_count, std::size_t column_count)
      : rows(std::uint32_t(row_count)),
        columns(std::uint32_t(column_count)),
        words(row_count * row_words()) {}
  std::size_t row_words() const { return (std::size_t(columns) + 31) / 32; }
  bool has(std::size_t row, std::size_t column) const {
    return words[row * row_words() + column / 32] >> (column % 32) & 1u;
  }
  void set(std::size_t row, std::size_t column) {
    words[row * row_words() + column / 32] |= 1u << (column % 32);
  }
};

}  // namespace edgescout
