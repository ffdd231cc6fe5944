#include "kernels/device_memory.h"

#include <gtest/gtest.h>

namespace edgescout::test {
namespace {

TEST(CountedMemory, RemembersTheMostThatWasHeldAtOnce) {
  const CountedMemory held(100);
  forget_peak_device_memory();
  const std::uint64_t start = peak_device_memory_bytes();
  {
    const CountedMemory a(1000);
    const CountedMemory b(500);
  }
  EXPECT_EQ(peak_device_memory_bytes(), start + 1500);
  const CountedMemory c(200);
  EXPECT_EQ(peak_device_memory_bytes(), start + 1500);
  forget_peak_device_memory();
  EXPECT_EQ(peak_device_memory_bytes(), start + 200);
}

TEST(CountedMemory, IsCountedOnceWhereverItMoves) {
  forget_peak_device_memory();
  const std::uint64_t start = peak_device_memory_bytes();
  CountedMemory a(300);
  CountedMemory b(std::move(a));
  CountedMemory c;
  c = std::move(b);
  c = CountedMemory();  // freed
  forget_peak_device_memory();
  EXPECT_EQ(peak_device_memory_bytes(), start);
}

}  // namespace
}  // namespace edgescout::test
