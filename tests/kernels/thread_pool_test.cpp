// Loops on several threads: each turn once, one loop at a time, failures rethrown.
#include "kernels/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace edgescout {
namespace {

TEST(ThreadPool, CallsEachTurnOnce) {
  for (const int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (const std::size_t count : {0, 1, 2, 3, 1000}) {
      std::vector<std::atomic<int>> calls(count);
      pool.for_each(count, [&](std::size_t i) { ++calls.at(i); });
      for (const std::atomic<int>& of_one : calls) EXPECT_EQ(of_one, 1);
    }
  }
}

// A worker that wakes late must not take turns of the next loop for those of the last one.
TEST(ThreadPool, KeepsShortLoopsApart) {
  ThreadPool pool(4);
  for (std::size_t loop = 0; loop < 5000; ++loop) {
    const std::size_t count = 2 + loop % 7;
    std::atomic<std::size_t> sum = 0;
    pool.for_each(count, [&, loop](std::size_t i) { sum += loop + i; });
    ASSERT_EQ(sum, count * loop + count * (count - 1) / 2) << loop;
  }
}

TEST(ThreadPool, UsesItsThreads) {
  ThreadPool pool(3);
  std::atomic<int> inside = 0;
  // Ends where all three are inside at once.
  pool.for_each(3, [&](std::size_t) {
    for (++inside; inside < 3;) std::this_thread::yield();
  });
  EXPECT_EQ(inside, 3);
}

TEST(ThreadPool, RunsALoopInsideALoopOnItsThread) {
  ThreadPool pool(3);
  std::atomic<int> strangers = 0, turns = 0;
  pool.for_each(20, [&](std::size_t) {
    const std::thread::id own = std::this_thread::get_id();
    pool.for_each(10, [&](std::size_t) {
      ++turns;
      if (std::this_thread::get_id() != own) ++strangers;
    });
  });
  EXPECT_EQ(turns, 200);
  EXPECT_EQ(strangers, 0);
}

TEST(ThreadPool, TakesLoopsOfSeveralThreadsInTurn) {
  ThreadPool pool(3);
  std::atomic<int> turns = 0;
  const auto loops = [&] {
    for (int i = 0; i < 200; ++i) pool.for_each(5, [&](std::size_t) { ++turns; });
  };
  std::thread other(loops);
  loops();
  other.join();
  EXPECT_EQ(turns, 2000);
}

TEST(ThreadPool, RethrowsAFailureAfterAllTurns) {
  ThreadPool pool(2);
  std::atomic<int> turns = 0;
  const auto failing = [&](std::size_t i) {
    ++turns;
    if (i % 3 == 1) throw std::runtime_error("turn failed");
  };
  EXPECT_THROW(pool.for_each(100, failing), std::runtime_error);
  EXPECT_EQ(turns, 100);
  EXPECT_NO_THROW(pool.for_each(100, [](std::size_t) {}));
}

}  // namespace
}  // namespace edgescout
