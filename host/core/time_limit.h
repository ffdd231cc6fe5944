// Ends long work early: at a deadline, or when the caller cancels it.
//
// Public header.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

namespace edgescout {

// What a call did before its limit was over it returns; what it had not begun it leaves out. Work
// ends soon after, not at once: the iteration or image in progress is completed.
struct TimeLimit {
  using Clock = std::chrono::steady_clock;

  std::optional<Clock::time_point> deadline;

  // Asked many times a second, by the calling thread alone. Once it has returned true, it must go
  // on to do so (latched).
  std::function<bool()> cancelled;

  // Over at once where `seconds` are negative or NaN. Of thirty years and more (infinity), the
  // deadline is the clock's last moment.
  static TimeLimit after(double seconds) {
    constexpr double most_s = 1e9;  // the clock counts ten times as many
    if (seconds >= most_s) return {Clock::time_point::max(), {}};
    const std::chrono::duration<double> given(seconds > 0 ? seconds : 0);
    return {Clock::now() + std::chrono::duration_cast<Clock::duration>(given), {}};
  }

  bool is_set() const { return deadline || cancelled; }
  bool is_cancelled() const { return cancelled && cancelled(); }
  bool is_over() const { return is_cancelled() || (deadline && Clock::now() >= *deadline); }
};

// Returns the same limit, which stays over once it was, whatever `cancelled` returns later.
inline TimeLimit latched(const TimeLimit& limit) {
  if (!limit.cancelled) return limit;
  return {limit.deadline, [cancelled = limit.cancelled, was = std::make_shared<bool>(false)] {
            return *was = *was || cancelled();
          }};
}

}  // namespace edgescout
