// A fixed set of threads for data-parallel loops. One loop at a time: a loop inside one runs on its
// own thread alone.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace edgescout {

class ThreadPool {
 public:
  // `threads` counts the calling thread; 0: as many as the machine has.
  explicit ThreadPool(int threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }
  // Calls body(i) for every i in [0, count), in any order, on all threads; returns when all are
  // done. The first exception is rethrown here. A call from inside a body runs its loop on that
  // thread alone.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& body);

 private:
  void work();
  void drain();
  bool has_work() const { return body_ && next_ < count_; }
  void stop();

  std::vector<std::thread> workers_;
  std::mutex loop_mutex_;  // held for the length of one loop
  // Taken without the mutex: bodies are short, and many threads would wait for it.
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;  // guards everything below; body_ and count_ stay while a worker is busy
  std::condition_variable wake_, done_;
  const std::function<void(std::size_t)>* body_ = nullptr;  // null between loops
  std::size_t count_ = 0, busy_workers_ = 0;
  std::exception_ptr failure_;
  bool stop_ = false;
};

// Calls body(i) for every i in [0, count), `chunk` of them at a time: for bodies that are short
// beside what it takes to hand one out.
template <typename Body>
void for_each_in_chunks(ThreadPool& pool, std::size_t count, std::size_t chunk, const Body& body) {
  pool.for_each((count + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) body(i);
  });
}

}  // namespace edgescout
