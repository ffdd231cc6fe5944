#include "host/core/log.h"

#include <utility>

namespace edgescout {

namespace {
LogSink& installed_sink() {
  static LogSink sink;
  return sink;
}
}  // namespace

void set_log_sink(LogSink sink) { installed_sink() = std::move(sink); }

void log(LogLevel level, const std::string& message) {
  if (const LogSink& sink = installed_sink()) sink(level, message);
}

}  // namespace edgescout
