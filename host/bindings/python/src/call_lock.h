// Lets one call at a time go on.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include "host/bindings/python/src/interrupt.h"
#include "kernels/error.h"

namespace edgescout::python {

// A mutex that is no trap for a call inside a call: one from a function or a signal handler of
// Python that the call in progress runs.
class CallLock {
 public:
  // `of`: whose calls they are, for messages.
  explicit CallLock(std::string of) : of_(std::move(of)) {}

  // LogicError: this thread has it already.
  void lock() { lock({}); }
  // Interrupted: a signal handler raised while another thread's call went on.
  void lock(const TimeLimit& limit) {
    if (holder_ == std::this_thread::get_id())
      throw LogicError(of_ + ": found a call inside another call, expected one after the other");
    while (!mutex_.try_lock_for(std::chrono::milliseconds(50)))
      if (limit.is_cancelled()) throw Interrupted{};
    holder_ = std::this_thread::get_id();
  }
  void unlock() {
    holder_ = std::thread::id{};
    mutex_.unlock();
  }

 private:
  std::string of_;
  std::timed_mutex mutex_;
  std::atomic<std::thread::id> holder_{};
};

}  // namespace edgescout::python
