// Memory for values that a loop writes before anyone reads them.
//
// A vector fills what it grows by, on one thread, which also gets the pages from the system. For
// large lists that takes longer than the loop.
#pragma once

#include <memory>
#include <type_traits>
#include <vector>

namespace edgescout {

// Leaves values without a given one as the memory is.
template <typename T>
struct UnfilledAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  UnfilledAllocator() = default;
  template <typename U>
  explicit UnfilledAllocator(const UnfilledAllocator<U>&) {}
  template <typename U>
  struct rebind {
    using other = UnfilledAllocator<U>;
  };
  template <typename U>
  void construct(U*) {}
  template <typename U, typename Argument, typename... Arguments>
  void construct(U* at, Argument&& first, Arguments&&... others) {
    std::construct_at(at, std::forward<Argument>(first), std::forward<Arguments>(others)...);
  }
};

template <typename T>
using Unfilled = std::vector<T, UnfilledAllocator<T>>;

}  // namespace edgescout
