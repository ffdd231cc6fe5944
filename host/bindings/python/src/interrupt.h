// Long calls without the interpreter's lock, which Ctrl-C ends.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>
#include <string>
#include <type_traits>

#include "host/core/time_limit.h"

namespace edgescout::python {

// Ends work where a signal handler raised, whose exception replaces this one.
struct Interrupted {};

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

// Begins now. ValueError: a number of seconds that is none or negative.
inline TimeLimit limit_after(std::optional<double> max_seconds) {
  if (!max_seconds) return {};
  if (!(*max_seconds >= 0))
    throw pybind11::value_error("max_seconds: found " + std::to_string(*max_seconds) +
                                ", expected 0 or more");
  return TimeLimit::after(*max_seconds);
}

// Calls work(limit) without the lock. The limit is over after `max_seconds`, where given, and where
// a signal handler raised: then its exception goes on. ValueError: as limit_after.
template <typename Work>
auto without_lock(std::optional<double> max_seconds, const Work& work) {
  Signals signals;
  TimeLimit limit = limit_after(max_seconds);
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
  if constexpr (std::is_void_v<decltype(work(limit))>) {
    work_unlocked();
    if (raised) throw pybind11::error_already_set();
  } else {
    auto result = work_unlocked();
    if (raised) throw pybind11::error_already_set();
    return result;
  }
}

// Calls work() without the lock. Ctrl-C is answered after it.
template <typename Work>
auto without_lock(const Work& work) {
  const pybind11::gil_scoped_release unlocked;
  return work();
}

}  // namespace edgescout::python
