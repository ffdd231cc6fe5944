// Values in rows and columns, in most uses one per pose and view.
//
// Public header.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace edgescout {

// Row-major; the values of one row lie side by side.
template <typename T>
class Grid {
 public:
  Grid() = default;
  Grid(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), values_(rows * columns) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  T& operator()(std::size_t row, std::size_t column) { return values_[row * columns_ + column]; }
  const T& operator()(std::size_t row, std::size_t column) const {
    return values_[row * columns_ + column];
  }
  std::span<T> row(std::size_t row) { return {values_.data() + row * columns_, columns_}; }
  std::span<const T> row(std::size_t row) const {
    return {values_.data() + row * columns_, columns_};
  }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<T> values_;
};

}  // namespace edgescout
