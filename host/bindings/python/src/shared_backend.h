// A backend that threads of Python share: one call at a time works on it.
#pragma once

#include <memory>
#include <mutex>

#include "host/bindings/python/src/call_lock.h"
#include "kernels/backend.h"

namespace edgescout::python {

class SharedBackend {
 public:
  explicit SharedBackend(std::unique_ptr<Backend> backend) : backend_(std::move(backend)) {}

  const Backend& info() const { return *backend_; }

  // Calls work(backend); others wait, until the limit is cancelled. The caller has given up the
  // interpreter's lock.
  template <typename Work>
  auto use(const TimeLimit& limit, const Work& work) {
    calls_.lock(limit);
    const std::scoped_lock lock(std::adopt_lock, calls_);
    return work(*backend_);
  }

 private:
  std::unique_ptr<Backend> backend_;
  CallLock calls_{"backend"};
};

using BackendPointer = std::shared_ptr<SharedBackend>;

// `given`, or that of "auto", made at the first use.
BackendPointer backend_or_usual(const BackendPointer& given);

// Calls work(limit, backend) without the interpreter's lock (without_lock).
template <typename Work>
auto on_backend(const BackendPointer& given, std::optional<double> max_seconds, const Work& work) {
  const BackendPointer backend = backend_or_usual(given);
  return without_lock(max_seconds, [&](const TimeLimit& limit) {
    return backend->use(limit, [&](Backend& on) { return work(limit, on); });
  });
}

}  // namespace edgescout::python
