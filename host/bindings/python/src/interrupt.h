// Long calls without the interpreter's lock, which Ctrl-C ends.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>

#include "host/core/time_limit.h"

namespace edgescout::python {

// Runs pending signal handlers; true where one of them raised. Takes the lock at most 20 times a
// second.
class Signals {
 public:
  bool pending() {
    const auto now = TimeLimit::Clock::now();
    if (now < next_) return false;
    next_ = now + std::chrono::milliseconds(50);
    const pybind11::gil_scoped_acquire lock;
    return PyErr_CheckSignals() != 0;
  }

 private:
  TimeLimit::Clock::time_point next_{};
};

// Calls work(limit) without the lock. The limit is over after `max_seconds`, where given, and where
// a signal handler raised: then its exception goes on.
template <typename Work>
auto without_lock(std::optional<double> max_seconds, const Work& work) {
  Signals signals;
  TimeLimit limit = max_seconds ? TimeLimit::after(*max_seconds) : TimeLimit{};
  bool raised = false;
  limit.cancelled = [&] { return raised = raised || signals.pending(); };
  const auto work_unlocked = [&] {
    try {
      const pybind11::gil_scoped_release unlocked;
      return work(limit);
    } catch (...) {
      if (raised) throw pybind11::error_already_set();
      throw;
    }
  };
  auto result = work_unlocked();
  if (raised) throw pybind11::error_already_set();
  return result;
}

}  // namespace edgescout::python
