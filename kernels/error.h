// The three ways something can go wrong, one exception type each.
//
// LogicError: our own bug; checks stay in release builds.
// InputError: what the user gave cannot be used; the message names file, field, found and expected.
// GpuError:   a Vulkan call failed; the message names the call or kernel and the VkResult.
// An expected absence (nothing found, not converged) is a value, never an exception.
//
// Public header.
#pragma once

#include <stdexcept>
#include <string>

namespace edgescout {

class LogicError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  // Writes the message "FILE: FIELD: found FOUND, expected EXPECTED"
  InputError(const std::string& file, const std::string& field, const std::string& found,
             const std::string& expected)
      : std::runtime_error(file + ": " + field + ": found " + found + ", expected " + expected) {}
};

class GpuError : public std::runtime_error {
 public:
  explicit GpuError(const std::string& message) : std::runtime_error(message) {}
};

// Throws LogicError with `message` unless `condition` holds.
inline void check(bool condition, const char* message) {
  if (!condition) throw LogicError(message);
}

}  // namespace edgescout
