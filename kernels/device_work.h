// What a device was asked to do. Counted where it is asked, in gpu/batch.h and gpu/buffer.h.
//
// Public header.
#pragma once

#include <cstdint>
#include <optional>

namespace edgescout {

struct DeviceWork {
  std::uint64_t submits = 0;
  std::uint64_t dispatches = 0;
  std::uint64_t bytes_up = 0;      // from the host to the device
  std::uint64_t bytes_down = 0;    // from the device to the host
  std::uint64_t bytes_filled = 0;  // set to one value on the device
  std::uint64_t allocations = 0;   // of device memory, staging included
  std::uint64_t timed = 0;         // dispatches whose time was taken
  double timed_seconds = 0;        // of these, on the device's clock

  // Returns the time of all dispatches; nothing where the time of one was not taken: a backend
  // takes times only where BackendOptions::time_kernels asks for them and its device has a clock.
  std::optional<double> kernel_seconds() const {
    return timed == dispatches ? std::optional(timed_seconds) : std::nullopt;
  }
};

inline DeviceWork& operator+=(DeviceWork& sum, const DeviceWork& more) {
  sum.submits += more.submits;
  sum.dispatches += more.dispatches;
  sum.bytes_up += more.bytes_up;
  sum.bytes_down += more.bytes_down;
  sum.bytes_filled += more.bytes_filled;
  sum.allocations += more.allocations;
  sum.timed += more.timed;
  sum.timed_seconds += more.timed_seconds;
  return sum;
}

// Returns what was done from `before` to `now`.
inline DeviceWork operator-(const DeviceWork& now, const DeviceWork& before) {
  return {now.submits - before.submits,
          now.dispatches - before.dispatches,
          now.bytes_up - before.bytes_up,
          now.bytes_down - before.bytes_down,
          now.bytes_filled - before.bytes_filled,
          now.allocations - before.allocations,
          now.timed - before.timed,
          now.timed_seconds - before.timed_seconds};
}

}  // namespace edgescout
