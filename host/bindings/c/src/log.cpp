#include "host/core/log.h"

#include <mutex>

#include "host/bindings/c/src/status.h"

namespace edgescout::c {

namespace {

struct Sink {
  edgescout_log_sink function = nullptr;
  void* user = nullptr;
};

struct SharedSink {
  std::mutex mutex;
  Sink sink;
};

SharedSink& shared_sink() {
  static SharedSink* const sink = new SharedSink;  // threads may log while the process ends
  return *sink;
}

// Outside the lock: a sink may set another one.
void relay(LogLevel level, const std::string& message) {
  Sink sink;
  {
    const std::scoped_lock lock(shared_sink().mutex);
    sink = shared_sink().sink;
  }
  if (sink.function) sink.function(std::int32_t(level), message.c_str(), sink.user);
}

// Once, before any thread can log.
[[maybe_unused]] const bool is_installed = [] {
  set_log_sink(relay);
  return true;
}();

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_set_log_sink(edgescout_log_sink sink, void* user) {
  return guarded([&] {
    const std::scoped_lock lock(shared_sink().mutex);
    shared_sink().sink = {sink, user};
  });
}
