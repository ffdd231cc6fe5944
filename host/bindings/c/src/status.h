// Statuses and messages of failed calls; exceptions end here.
#pragma once

#include <exception>
#include <string>

#include "host/bindings/c/edgescout.h"

namespace edgescout::c {

// A failure that the C interface itself finds.
class Failure : public std::exception {
 public:
  Failure(edgescout_status status, std::string message)
      : status_(status), message_(std::move(message)) {}
  edgescout_status status() const { return status_; }
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  edgescout_status status_;
  std::string message_;
};

// "NAME: found FOUND, expected EXPECTED".
[[noreturn]] void refuse(edgescout_status status, const std::string& name, const std::string& found,
                         const std::string& expected);

// EDGESCOUT_NULL where `pointer` is.
void require(const void* pointer, const char* name);

// EDGESCOUT_BAD_INPUT: `index` is not below `count`.
void require_index(std::size_t index, std::size_t count, const char* name);

// EDGESCOUT_BAD_INPUT: a number of items that no caller has, which would be read from anywhere.
void require_count(std::size_t count, const char* name);

// Keeps the message of the exception in flight for edgescout_last_error.
edgescout_status status_of_exception() noexcept;

template <typename Work>
edgescout_status guarded(const Work& work) noexcept {
  try {
    work();
    return EDGESCOUT_OK;
  } catch (...) {
    return status_of_exception();
  }
}

}  // namespace edgescout::c
